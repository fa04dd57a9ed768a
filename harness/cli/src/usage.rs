//! Help of the program, and messages on arguments that it does not take.

use std::ffi::OsString;

use clap::{
    Command, Error,
    error::{ContextKind, ContextValue, ErrorKind},
};

use files::outcome::STATUSES;

/// The commands by what they are about, as the help lists them.
const GROUPS: [(&str, &[&str]); 3] = [
    ("Any FMU", &["info", "check", "run", "wire", "sweep", "compare", "plot"]),
    ("Your spacecraft", &["new", "draw", "map", "size", "pack", "ephemeris"]),
    ("Plans", &["plan", "refit"]),
];

/// Earlier forms: the command, a word of its arguments (`""` for the command itself), and the form that replaces it.
const EARLIER: [(&str, &str, &str); 14] = [
    ("schema", "", "heliotorque new --schema KIND"),
    ("study", "", "cargo xtask study NAME` of the sources, which runs `harness/studies/<subject>/<name>.py"),
    ("plan", "momentum", "heliotorque plan FILE"),
    ("plan", "flyby", "heliotorque plan FILE"),
    ("plan", "leg", "heliotorque plan FILE"),
    ("plan", "--rate-rpm", "heliotorque plan spin --rate 5rpm"),
    ("plan", "--rate-uncertainty-rpm", "heliotorque plan spin --rate-uncertainty 0.1rpm"),
    ("plan", "--fmu", "heliotorque plan spin --template FMU"),
    ("run", "--plot", "heliotorque run FMU --output FILE.svg"),
    ("compare", "--plot", "heliotorque compare FIRST SECOND --output FILE.svg"),
    ("map", "--csv", "heliotorque map FILE --output FILE.csv"),
    ("map", "--mission", "heliotorque map FILE --recording CSV"),
    ("check", "--only", "heliotorque check FMU --probe TEXT"),
    ("ephemeris", ".fmu", "heliotorque ephemeris --template FMU"),
];

/// The program with its commands in groups, and the exit statuses below.
pub(crate) fn with_help(program: Command) -> Command {
    let mut groups = String::new();
    for (group, names) in GROUPS {
        groups.push_str(&format!("\n{group}:\n"));
        for name in names {
            let about = program.find_subcommand(name).and_then(Command::get_about);
            groups.push_str(&format!("  {name:<11}{}\n", about.cloned().unwrap_or_default()));
        }
    }
    let statuses: String = STATUSES.iter().map(|(status, what)| format!("  {status:<5}{what}\n")).collect();
    program
        .help_template(format!(
            "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n{groups}\nOptions:\n{{options}}{{after-help}}"
        ))
        .after_help(format!("Exit status:\n{}", statuses.trim_end()))
}

/// Ends the program: with help where that was requested, else with what is wrong.
pub(crate) fn end(program: &Command, arguments: &[OsString], mut error: Error) -> ! {
    let refused = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(refused)) => refused.as_str(),
        _ => "",
    };
    if let Some(now) = replacement(arguments, refused).filter(|_| error.use_stderr()) {
        let given: Vec<_> = arguments.iter().map(|it| it.to_string_lossy()).collect();
        error = program.clone().error(
            ErrorKind::UnknownArgument,
            format!("`heliotorque {}` is an earlier form, allowed: `{now}`", given.join(" ")),
        );
    }
    if let Some(ContextValue::Strings(names)) = error.get(ContextKind::SuggestedSubcommand) {
        let is_shown = |name: &&String| program.find_subcommand(name).is_some_and(|it| !it.is_hide_set());
        let shown: Vec<String> = names.iter().filter(is_shown).cloned().collect();
        error.remove(ContextKind::SuggestedSubcommand);
        if !shown.is_empty() {
            error.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(shown));
        }
    }
    error.exit()
}

/// Returns the form that replaces an earlier one; `refused` is the argument that clap does not take.
fn replacement(arguments: &[OsString], refused: &str) -> Option<&'static str> {
    let (command, rest) = arguments.split_first()?;
    let is_given = |word: &str| match word {
        "" => true,
        _ if word.starts_with(['-', '.']) => refused.starts_with(word) || refused.ends_with(word),
        _ => rest.first().is_some_and(|first| first == word),
    };
    let found = EARLIER.iter().find(|(of, word, _)| *of == *command && is_given(word));
    found.map(|(_, _, now)| *now)
}
