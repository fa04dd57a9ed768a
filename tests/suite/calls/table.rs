//! Table 1.1 of the rules typed a second time, as the text writes it: one letter a state, one row a function.

/// instantiated, InitializationMode, stepComplete, stepInProgress, stepFailed, stepCanceled, terminated, error.
pub(super) const STATES: &str = "IMCPFXTE";

/// `x` allowed, `.` forbidden, a digit: allowed under that note.
const ROWS: &[(&str, &[&str])] = &[
    ("xxxxxxxx", &["GetTypesPlatform", "GetVersion"]),
    ("xxxxxxxx", &["SetDebugLogging"]),
    ("xxx.xxxx", &["FreeInstance", "Reset", "SetFMUstate", "FreeFMUstate"]),
    ("xxx.xxxx", &["SerializedFMUstateSize", "SerializeFMUstate", "DeSerializeFMUstate"]),
    ("x.......", &["SetupExperiment", "EnterInitializationMode"]),
    (".x......", &["ExitInitializationMode"]),
    ("..x.x...", &["Terminate"]),
    (".2x.87x7", &["GetReal", "GetInteger", "GetBoolean", "GetString"]),
    ("136.....", &["SetReal", "SetInteger", "SetBoolean", "SetString"]),
    ("xxx.87x7", &["GetFMUstate"]),
    (".xx.87x7", &["GetDirectionalDerivative"]),
    ("xxx.....", &["SetRealInputDerivatives"]),
    ("..x.8xx7", &["GetRealOutputDerivatives"]),
    ("..x.....", &["DoStep"]),
    ("...x....", &["CancelStep"]),
    ("..xxx.x.", &["GetStatus", "GetRealStatus", "GetIntegerStatus", "GetBooleanStatus", "GetStringStatus"]),
];

/// The cell of a function (without `fmi2`) and a state letter; `.` for the state that allows nothing, fatal.
pub(super) fn cell(function: &str, state: char) -> char {
    let row = ROWS.iter().find(|(_, functions)| functions.contains(&function));
    let (row, _) = row.unwrap_or_else(|| panic!("no row for {function}"));
    STATES.find(state).map_or('.', |column| char::from(row.as_bytes()[column]))
}

/// Every function of the table.
pub(super) fn functions() -> impl Iterator<Item = &'static str> {
    ROWS.iter().flat_map(|(_, functions)| functions.iter().copied())
}

mod tests {
    use model_description::call_table::{Access, CALL_TABLE, Function, State};

    use super::{STATES, cell, functions};

    /// Cells in which the exporter's table differs from this one: function, state letter, what the exporter has.
    fn differences(cell: impl Fn(&'static str, char) -> char) -> Vec<(&'static str, char, char)> {
        let mut found = Vec::new();
        for (row, function) in Function::ALL.iter().enumerate() {
            if *function == Function::Instantiate {
                continue;
            }
            let name = function.symbol().strip_prefix("fmi2").unwrap();
            for (letter, state) in STATES.chars().chain(['!']).zip(State::ALL) {
                let exporters = match CALL_TABLE[row][state as usize] {
                    Access::Forbidden => '.',
                    Access::Allowed => 'x',
                    Access::Conditional(condition) => char::from_digit(condition.number(), 10).unwrap(),
                };
                if exporters != cell(name, letter) {
                    found.push((name, letter, exporters));
                }
            }
        }
        found
    }

    /// Exporter, checker and documentation use one table; this is the second witness.
    #[test]
    fn the_exporters_table_is_the_standards() {
        assert_eq!(differences(cell), []);
    }

    #[test]
    fn every_broken_cell_is_a_difference() {
        for function in functions() {
            for state in STATES.chars().chain(['!']) {
                let right = cell(function, state);
                for wrong in ".x12345678".chars().filter(|wrong| *wrong != right) {
                    let broken =
                        |name, at| if (name, at) == (function, state) { wrong } else { cell(name, at) };
                    assert_eq!(differences(broken), [(function, state, right)], "{wrong}");
                }
            }
        }
    }
}
