//! Causalities in words.

use model_description::{Causality, ScalarVariable, Variability};

/// Causalities in reading order, in words.
pub(super) const CAUSALITIES: [(Causality, &str); 6] = [
    (Causality::Parameter, "parameter"),
    (Causality::CalculatedParameter, "calculated parameter"),
    (Causality::Input, "input"),
    (Causality::Output, "output"),
    (Causality::Local, "local"),
    (Causality::Independent, "independent"),
];

/// Causality, with what the variability adds to it.
pub(super) fn causality(variable: &ScalarVariable) -> String {
    let name = CAUSALITIES.iter().find(|(it, _)| *it == variable.causality).map_or("", |(_, name)| name);
    match (variable.causality, variable.variability) {
        (Causality::Parameter, Variability::Tunable) => "tunable parameter".to_owned(),
        (_, Variability::Constant) => format!("constant {name}"),
        (Causality::Input | Causality::Output, Variability::Discrete) => format!("{name}, discrete"),
        _ => name.to_owned(),
    }
}
