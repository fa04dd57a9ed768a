//! Inputs over time: a table of rows, interpolated where the variable is continuous.

mod interpolation;
mod meaning;
mod pulses;

use std::{collections::HashMap, sync::Arc};

use model_description::{Causality, Description, ScalarVariable, Variability, VariableKind, value};

use self::interpolation::{Circle, Gap, Quaternion, half_turn_rad};
use crate::{Error, Times, Value, select};

/// Values of inputs (and tunable parameters) over time.
///
/// Between rows continuous Reals are interpolated: the four elements of a quaternion as one turn, by their body rate where it has
/// columns too; angles by the nearest turn; a position with its velocity as a cubic; all others linearly. Anything else keeps the
/// last row's value; before the first row and after the last the nearest row holds. Two rows at one time make a jump: the
/// later one holds from there on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputTable {
    columns: Vec<InputColumn>,
    attitudes: Vec<AttitudeColumns>,
}

/// Turn between two rows, in deg, beyond which a body rate is missed.
const MAX_TURN_DEG: f64 = 1.0;

#[derive(Clone, Debug, PartialEq)]
struct InputColumn {
    position: usize,
    interpolation: Interpolation,
    /// Shared by the columns of one file.
    times_s: Arc<[f64]>,
    values: Vec<Value>,
}

/// Interpolation between two rows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Interpolation {
    /// The earlier row.
    Held,
    /// A straight line.
    Linear,
    /// A straight line by the nearest turn.
    Angle(Circle),
    /// A cubic by the rates in another column.
    Cubic { rate: usize },
    /// The rate of that cubic.
    CubicRate { of: usize },
    /// An element of an attitude.
    Attitude { number: usize, element: usize },
    /// An element of its body rate.
    BodyRate { number: usize, element: usize },
}

/// Columns of a quaternion, which have one sign from row to row, and of its body rate.
#[derive(Clone, Debug, PartialEq)]
struct AttitudeColumns {
    vector: String,
    rate_name: Option<String>,
    q: [usize; 4],
    rate: Option<[usize; 3]>,
}

impl InputTable {
    /// Builds a table from texts, as read from a file: `header` starts with `time`, every row has its length.
    pub fn parse<S: AsRef<str>>(
        description: &Description,
        header: &[S],
        rows: &[Vec<S>],
    ) -> Result<Self, Error> {
        let wrong = |what: String| Error::Inputs(what);
        let Some((time, names)) = header.split_first() else {
            return Err(wrong("it is empty; the first line names its columns: time,<input>,...".to_owned()));
        };
        if time.as_ref().trim() != "time" {
            return Err(wrong(format!("the first column is {:?} and must be time, in s", time.as_ref())));
        }
        let variables = names.iter().map(|name| settable(description, name.as_ref().trim()));
        let variables: Vec<(usize, &ScalarVariable)> = variables.collect::<Result<_, _>>()?;
        for (index, (position, variable)) in variables.iter().enumerate() {
            if variables[..index].iter().any(|(earlier, _)| earlier == position) {
                return Err(wrong(format!("column {} stands twice", variable.name)));
            }
        }
        let mut times_s: Vec<f64> = Vec::with_capacity(rows.len());
        let mut values = vec![Vec::with_capacity(rows.len()); variables.len()];
        for (index, row) in rows.iter().enumerate() {
            let line = index + 2;
            if row.len() != header.len() {
                return Err(wrong(format!(
                    "line {line} has {} cells, the header has {}",
                    row.len(),
                    header.len()
                )));
            }
            let text = row[0].as_ref().trim();
            let time_s = text
                .parse::<f64>()
                .ok()
                .filter(|time_s| time_s.is_finite())
                .ok_or_else(|| wrong(format!("line {line}: time {text:?} is no number")))?;
            if times_s.last().is_some_and(|last| *last > time_s) {
                return Err(wrong(format!("line {line}: time {time_s} is before the line above")));
            }
            times_s.push(time_s);
            for ((column, (_, variable)), cell) in values.iter_mut().zip(&variables).zip(&row[1..]) {
                let value = value::read_cell(description, variable, cell.as_ref())
                    .map_err(|misfit| wrong(format!("line {line}: {}: {misfit}", variable.name)))?;
                column.push(value);
            }
        }
        if times_s.is_empty() {
            return Err(wrong("it has a header but no rows".to_owned()));
        }
        let times_s: Arc<[f64]> = times_s.into();
        let columns = variables.iter().zip(values).map(|(&(position, _), values)| {
            InputColumn::new(description, position, Arc::clone(&times_s), values)
        });
        let mut table = Self { columns: columns.collect(), attitudes: Vec::new() };
        table.relate(description);
        Ok(table)
    }

    /// Adds a variable with rows of its own: a time in s, that does not fall, and a value.
    ///
    /// # Errors
    /// No rows, times that fall, a variable that cannot change during a run or has rows already.
    pub fn add(
        &mut self,
        description: &Description,
        name: &str,
        rows: Vec<(f64, Value)>,
    ) -> Result<(), Error> {
        let (position, _) = settable(description, name)?;
        if self.positions().any(|other| other == position) {
            return Err(Error::Inputs(format!("{name} stands twice")));
        }
        let (times_s, values): (Vec<f64>, Vec<Value>) = rows.into_iter().unzip();
        if times_s.is_empty() || times_s.windows(2).any(|pair| pair[1] < pair[0]) {
            return Err(Error::Inputs(format!("{name} has no rows, or rows whose times fall")));
        }
        self.columns.push(InputColumn::new(description, position, times_s.into(), values));
        self.relate(description);
        Ok(())
    }

    /// Positions in `ModelVariables` of the columns.
    pub fn positions(&self) -> impl Iterator<Item = usize> {
        self.columns.iter().map(|column| column.position)
    }

    /// The value of a column at a time.
    pub fn value(&self, column: usize, time_s: f64) -> Value {
        let after = self.columns[column].times_s.partition_point(|row_s| *row_s <= time_s);
        self.between(column, after, time_s)
    }

    /// Mean rate of a column that is interpolated over a step, up to the first jump in it: with that slope an input reaches the
    /// value at the end. `None` for one that is held.
    pub fn slope(&self, column: usize, [start_s, end_s]: [f64; 2]) -> Option<f64> {
        let InputColumn { interpolation, times_s, .. } = &self.columns[column];
        if *interpolation == Interpolation::Held {
            return None;
        }
        let first = times_s.partition_point(|row_s| *row_s <= start_s);
        let within = times_s[first..].windows(2).take_while(|pair| pair[0] < end_s);
        let end_s = within.filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).next().unwrap_or(end_s);
        let end = times_s.partition_point(|row_s| *row_s < end_s);
        let [from, to] = [(first, start_s), (end, end_s)]
            .map(|(after, time_s)| self.between(column, after, time_s).to_f64());
        let way =
            if let Interpolation::Angle(circle) = interpolation { circle.way(from, to) } else { to - from };
        Some(way / (end_s - start_s))
    }

    /// Lines on what a run with these communication points does not make of the rows: see [`Self::coarse_turns`] and
    /// [`Self::lost_pulses`].
    pub fn warnings(&self, description: &Description, times: &Times) -> Vec<String> {
        [self.coarse_turns(), self.lost_pulses(description, times)].concat()
    }

    /// A line for each attitude without a body rate whose rows are more than a degree apart, with the widest gap.
    pub fn coarse_turns(&self) -> Vec<String> {
        let is_alone = |attitude: &&AttitudeColumns| attitude.rate.is_none();
        let line = |attitude: &AttitudeColumns| {
            let times_s = &self.columns[attitude.q[0]].times_s;
            let gaps = (1..times_s.len()).filter(|row| times_s[*row] > times_s[row - 1]);
            let turn_deg = |row: usize| {
                let [(left, _), (right, _)] =
                    [self.attitude(attitude, row - 1)?, self.attitude(attitude, row)?];
                Some((2.0 * half_turn_rad(left, right).to_degrees(), row))
            };
            let widest = gaps.filter_map(turn_deg).max_by(|(one, _), (other, _)| one.total_cmp(other));
            let (turn_deg, row) = widest.filter(|(turn_deg, _)| *turn_deg > MAX_TURN_DEG)?;
            let [from_s, to_s] = [times_s[row - 1], times_s[row]];
            let vector = &attitude.vector;
            let rate = attitude.rate_name.as_deref().unwrap_or("its body rate");
            Some(format!(
                "{vector} turns by {turn_deg:.1} deg from {from_s} s to {to_s} s, found no {rate} beside it: the turn between the rows is \
                 taken at a constant rate; rows at most {MAX_TURN_DEG} deg apart, or {rate}, say it better"
            ))
        };
        self.attitudes.iter().filter(is_alone).filter_map(line).collect()
    }

    /// The value of a column before its row `after`, at a time from the row before that on.
    fn between(&self, column: usize, after: usize, time_s: f64) -> Value {
        let InputColumn { interpolation, times_s, values, .. } = &self.columns[column];
        let before = after.saturating_sub(1);
        let held = || values[before].clone();
        if after == 0 || after == values.len() || time_s == times_s[before] {
            return held();
        }
        if time_s == times_s[after] && *interpolation != Interpolation::Held {
            return values[after].clone();
        }
        let span_s = times_s[after] - times_s[before];
        let gap = Gap { span_s, share: (time_s - times_s[before]) / span_s };
        let ends = |column: usize| self.columns[column].reals([before, after]);
        let turned = |number: usize| self.turned(&self.attitudes[number], gap, [before, after]);
        let value = match *interpolation {
            Interpolation::Held => None,
            Interpolation::Linear => Some(gap.linear(ends(column))),
            Interpolation::Angle(circle) => Some(circle.between(gap, ends(column))),
            Interpolation::Cubic { rate } => Some(gap.cubic(ends(column), ends(rate)).0),
            Interpolation::CubicRate { of } => Some(gap.cubic(ends(of), ends(column)).1),
            Interpolation::Attitude { number, element } => turned(number).map(|(q, _)| q[element]),
            Interpolation::BodyRate { number, element } => turned(number).map(|(_, rate)| rate[element]),
        };
        value.map_or_else(held, Value::Real)
    }

    /// An attitude with its norm and its body rate between two rows; `None` beside a quaternion of zeros.
    fn turned(
        &self,
        attitude: &AttitudeColumns,
        gap: Gap,
        rows: [usize; 2],
    ) -> Option<(Quaternion, [f64; 3])> {
        let [(left, left_norm), (right, right_norm)] =
            [self.attitude(attitude, rows[0])?, self.attitude(attitude, rows[1])?];
        let norm = gap.linear([left_norm, right_norm]);
        let (q, rate) = match attitude.rate {
            Some(rate) => {
                let rates = rows.map(|row| rate.map(|column| self.columns[column].real(row)));
                gap.turned_by_rates([left, right], rates)
            }
            None => (gap.turned([left, right]), [0.0; 3]),
        };
        Some((q.map(|element| norm * element), rate))
    }

    /// The unit quaternion of a row and the norm that it was given with.
    fn attitude(&self, attitude: &AttitudeColumns, row: usize) -> Option<(Quaternion, f64)> {
        let q = attitude.q.map(|column| self.columns[column].real(row));
        let norm = q.iter().map(|element| element * element).sum::<f64>().sqrt();
        (norm > 0.0).then(|| (q.map(|element| element / norm), norm))
    }

    /// Finds the columns that are interpolated together, of one file or with equal times.
    fn relate(&mut self, description: &Description) {
        let variable = |column: &InputColumn| &description.variables[column.position];
        let name = |column: &InputColumn| variable(column).name.as_str();
        let by_name: HashMap<&str, usize> =
            self.columns.iter().enumerate().map(|(number, column)| (name(column), number)).collect();
        let beside = |first: usize, name: &str| {
            let number = *by_name.get(name)?;
            let column = &self.columns[number];
            let is_linear = column.interpolation != Interpolation::Held;
            (is_linear && column.times_s == self.columns[first].times_s).then_some(number)
        };
        let elements = |first: usize, vector: &str, count: usize| -> Option<Vec<usize>> {
            (1..=count).map(|element| beside(first, &format!("{vector}[{element}]"))).collect()
        };
        let mut attitudes = Vec::new();
        let mut cubics = Vec::new();
        for (number, column) in self.columns.iter().enumerate() {
            if let Some((vector, rate_name)) = meaning::quaternion(variable(column))
                && let Some(Ok(q)) = elements(number, vector, 4).map(TryInto::try_into)
            {
                let rate = rate_name.and_then(|rate| elements(number, rate, 3)?.try_into().ok()).filter(
                    |rate: &[usize; 3]| {
                        let is_rate =
                            |it: &usize| meaning::is_angular_rate(description, variable(&self.columns[*it]));
                        rate.iter().all(is_rate)
                    },
                );
                let rate_name = rate_name.map(str::to_owned);
                attitudes.push(AttitudeColumns { vector: vector.to_owned(), rate_name, q, rate });
            }
            let rate = meaning::velocity_name(variable(column)).and_then(|name| beside(number, name));
            let rate = rate.filter(|rate| {
                let rate = variable(&self.columns[*rate]);
                meaning::is_rate_of(description, rate, variable(column))
            });
            cubics.extend(
                rate.filter(|_| column.interpolation != Interpolation::Held).map(|rate| (number, rate)),
            );
        }
        for (of, rate) in cubics {
            self.columns[of].interpolation = Interpolation::Cubic { rate };
            self.columns[rate].interpolation = Interpolation::CubicRate { of };
        }
        for (number, attitude) in attitudes.iter().enumerate() {
            for (element, column) in attitude.q.into_iter().enumerate() {
                self.columns[column].interpolation = Interpolation::Attitude { number, element };
            }
            for (element, column) in attitude.rate.into_iter().flatten().enumerate() {
                self.columns[column].interpolation = Interpolation::BodyRate { number, element };
            }
            self.align(attitude.q);
        }
        self.attitudes = attitudes;
    }

    /// Gives the quaternion of each row the sign that is nearer to the row above.
    fn align(&mut self, q: [usize; 4]) {
        for row in 1..self.columns[q[0]].values.len() {
            let product: f64 =
                q.iter().map(|it| self.columns[*it].real(row - 1) * self.columns[*it].real(row)).sum();
            if product < 0.0 {
                q.iter()
                    .for_each(|it| self.columns[*it].values[row] = Value::Real(-self.columns[*it].real(row)));
            }
        }
    }
}

impl InputColumn {
    /// With an interpolation of its own.
    fn new(description: &Description, position: usize, times_s: Arc<[f64]>, values: Vec<Value>) -> Self {
        let variable = &description.variables[position];
        let mut column = Self { position, interpolation: Interpolation::Held, times_s, values };
        if is_linear(variable) {
            column.interpolation = Interpolation::Linear;
            let numbers: Vec<f64> = column.values.iter().map(Value::to_f64).collect();
            if let Some(circle) = meaning::angle(description, variable).filter(|it| !it.is_counted(&numbers))
            {
                column.interpolation = Interpolation::Angle(circle);
                column.values = circle.unwrapped(&numbers).into_iter().map(Value::Real).collect();
            }
        }
        column
    }

    fn real(&self, row: usize) -> f64 {
        self.values[row].to_f64()
    }

    fn reals(&self, rows: [usize; 2]) -> [f64; 2] {
        rows.map(|row| self.real(row))
    }
}

fn is_linear(variable: &ScalarVariable) -> bool {
    matches!(variable.kind, VariableKind::Real { .. })
        && variable.causality == Causality::Input
        && variable.variability == Variability::Continuous
}

/// Position and variable of a name, one that can change during a run.
fn settable<'a>(description: &'a Description, name: &str) -> Result<(usize, &'a ScalarVariable), Error> {
    let position = select::named(description, name).ok_or_else(|| select::unknown(description, name))?;
    let variable = &description.variables[position];
    let tunable = variable.causality == Causality::Parameter && variable.variability == Variability::Tunable;
    if variable.causality == Causality::Input || tunable {
        return Ok((position, variable));
    }
    let what = "cannot change during a run: only inputs and tunable parameters can";
    Err(Error::Inputs(format!("{} {what}", variable.name)))
}
