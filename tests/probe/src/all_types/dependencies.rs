//! Dependencies of the outputs of `AllTypes`: each on the variable that it repeats.

use fmi_export::{Dependencies, Knowns, knowns};

use super::AllTypesVariables;

pub(super) fn table(v: &AllTypesVariables) -> Dependencies {
    let mut table = Dependencies::new();
    let nothing = &knowns![];
    for (from, to, gain) in v.pairs() {
        table.output(to, from, knowns![from].and(gain.into_iter().collect::<Knowns>()));
    }
    let (input, output, tunable, echo, role) = (&v.input, &v.output, &v.tunable, &v.echo, &v.role);
    table.output(output.discrete_real, input.discrete_real, input.discrete_real);
    table.output(output.integer, input.integer, input.integer);
    table.output(output.boolean, input.boolean, input.boolean);
    table.output(output.text, input.text, input.text);
    table.output(output.choice, input.choice, input.choice);
    table.output(output.integral, nothing, nothing);
    table.output(echo.real, nothing, tunable.real);
    for i in 0..3 {
        table.output(echo.vector.element(i), nothing, tunable.vector.element(i));
    }
    for (row, column) in (0..6).map(|i| (i / 3, i % 3)) {
        table.output(echo.matrix.element(row, column), nothing, tunable.matrix.element(row, column));
    }
    table.output(echo.integer, nothing, tunable.integer);
    table.output(echo.boolean, nothing, tunable.boolean);
    table.output(echo.text, nothing, tunable.text);
    table.output(echo.choice, nothing, tunable.choice);
    table.output(role.output_exact, nothing, nothing);
    table.output(role.output_approx, nothing, nothing);
    table.calculated(role.calculated_fixed, v.parameter.real);
    table.calculated(role.calculated_approx, v.parameter.real);
    table.calculated(role.calculated_tunable, tunable.real);
    table
}
