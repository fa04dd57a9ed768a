//! The FMU's host: callbacks, paths, names, locale, threads.

use crate::{Callbacks, Error, Fmu, Instance, InstanceOptions, LogMessage, Resources, Status, copy_folder};

use crate::conformance::{
    experiment::{self, Bits, STEPS},
    findings::{Findings, Outcome},
    probe::Trial,
};

/// The callbacks' struct ends with `fmi2Instantiate` (2.0.5); memory functions may be NULL if the FMU declares it.
pub(crate) fn callbacks(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let may_be_null = fmu.co_simulation()?.can_not_use_memory_management_functions;
    for (what, null_memory, overwritten) in [
        ("runs on after the struct of callbacks is overwritten", false, true),
        ("runs with NULL for allocateMemory and freeMemory, as it claims", true, false),
        ("runs with both", true, true),
    ] {
        if may_be_null || !null_memory {
            let callbacks = Callbacks { null_memory, overwritten };
            let options = InstanceOptions { callbacks, ..experiment::strict() };
            findings.expect_alike(fmu, &options, &expected, what);
        }
    }
    if !may_be_null {
        findings.skipped("NULL memory functions: it claims to need them");
    }
    Ok(())
}

impl Findings<'_> {
    /// Adds whether a short simulation with these options gives these bits.
    fn expect_alike(&mut self, fmu: &Fmu, options: &InstanceOptions, expected: &Bits, what: &str) {
        match experiment::short_simulation(fmu, options) {
            Ok(found) => self.expect(found == *expected, what),
            Err(error) => self.bad(format!("not so: {what}\n{error}")),
        }
    }
}

/// NULL where nothing is to be read or written.
pub(crate) fn nulls(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let mut instance = experiment::ready(fmu, &experiment::unchecked())?;
    let state_calls = fmu.co_simulation()?.can_get_and_set_fmu_state;
    let answers = instance.probe_nulls().into_iter();
    for (name, answer) in answers.filter(|(name, _)| *name != "fmi2FreeFMUstate" || state_calls) {
        survived(findings, name, [&format!("{name} with NULL for nothing"), ""], answer);
    }
    Ok(())
}

/// "If a null pointer is provided, the call is ignored" (2.1.8): the pointer to the state, or the state itself.
pub(crate) const TRIALS: &[Trial] = &[Trial {
    probe: "nulls",
    call: "fmi2FreeFMUstate(instance, NULL)",
    what: "the pointer to the state is NULL",
    senseless: false,
    disputed: true,
    run: free_no_state,
}];

fn free_no_state(findings: &mut Findings<'_>, trial: &Trial) -> Outcome {
    if !findings.fmu.co_simulation()?.can_get_and_set_fmu_state {
        findings.skipped(format!("{}: states are not claimed", trial.call));
        return Ok(());
    }
    let mut instance = experiment::ready(findings.fmu, &experiment::unchecked())?;
    let answer = instance.probe_free_no_state();
    survived(findings, trial.call, [trial.call, " is ignored (2.1.8)"], answer);
    Ok(())
}

/// Adds what a call did: good where the answer is, otherwise a note.
fn survived(
    findings: &mut Findings<'_>,
    call: &str,
    [what, good]: [&str; 2],
    answer: Result<Status, String>,
) {
    match answer {
        Ok(Status::Ok | Status::Warning) => findings.good(format!("{what}{good}")),
        Ok(status) => findings.note(format!("{what} answers {status}")),
        Err(missing) => findings.note(format!("{call}: {missing}")),
    }
}

/// Folders that path handling stumbles over.
const STRANGE: [&str; 6] =
    ["with space", "50% off", "a+b", "{braces} #1", "Überraum λ 火星", "dots..and~tilde"];

/// Moves the FMU to strange places and runs it there.
pub(crate) fn paths(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let scratch = tempfile::tempdir().map_err(Error::file(&std::env::temp_dir()))?;
    for name in STRANGE {
        let place = scratch.path().join(name);
        copy_folder(fmu.folder(), &place)?;
        let there = Fmu::open(&place)?;
        let what = format!("runs from a folder called {name:?}");
        findings.expect_alike(&there, &experiment::strict(), &expected, &what);
    }
    let own = crate::file_uri(&fmu.folder().join("resources"));
    let path = own.trim_start_matches("file://").to_owned();
    for (what, uri) in [
        ("takes file:/path", format!("file:{path}")),
        ("takes file://localhost/path", format!("file://localhost{path}")),
        ("takes a resource location with a slash at its end", format!("{own}/")),
    ] {
        let options = InstanceOptions { resources: Resources::Uri(uri), ..experiment::strict() };
        match experiment::short_simulation(fmu, &options) {
            Ok(found) => findings.expect(found == expected, what),
            Err(error) => findings.note(format!("not so: {what}\n{error}")),
        }
    }
    // Whatever it answers to these, it must continue.
    for (what, resources) in [
        ("NULL", Resources::Absent),
        ("an empty text", Resources::Uri(String::new())),
        ("a folder that is not there", Resources::Uri("file:///no/such/folder".to_owned())),
        ("no URI at all", Resources::Uri("%zz:// %".to_owned())),
    ] {
        let options = InstanceOptions { resources, ..experiment::strict() };
        let runs =
            if Instance::new(fmu, "probe", &options).is_ok() { "instantiates" } else { "gives no instance" };
        findings.good(format!("{runs} with {what} for the resource location, and goes on"));
    }
    Ok(())
}

/// GUIDs and names.
pub(crate) fn identity(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    for guid in ["", "{00000000-0000-0000-0000-000000000000}", "100 %s %n #r1#"] {
        let options = InstanceOptions { guid: Some(guid.to_owned()), ..experiment::unchecked() };
        match Instance::new(fmu, "probe", &options) {
            Ok(_) => findings.bad(format!("gives an instance for the GUID {guid:?}, which is not its own")),
            Err(Error::Call(call)) if !call.messages.is_empty() => {
                findings
                    .good(format!("refuses the GUID {guid:?} with the message: {}", text(&call.messages)));
            }
            Err(_) => findings.note(format!("refuses the GUID {guid:?} without a word")),
        }
    }
    for name in ["100 % done %s %n", "#r0# and ## and #", "Überraum λ 火星", "a\tb\nc", &"long ".repeat(1000)]
    {
        let shown: String = name.chars().take(20).collect();
        let what = format!("takes the instance name {shown:?}");
        findings.done(&what, Instance::new(fmu, name, &experiment::strict()).map(drop));
    }
    for name in ["", "   "] {
        let outcome = Instance::new(fmu, name, &experiment::unchecked());
        match outcome {
            Err(_) => findings.good(format!("refuses the instance name {name:?}")),
            Ok(_) => findings.note(format!("takes the instance name {name:?}, which names nothing (2.1.5)")),
        }
    }
    // Two instances of one name are two instances.
    let mut one = experiment::ready(fmu, &experiment::strict())?;
    if !fmu.co_simulation()?.can_be_instantiated_only_once_per_process {
        let mut two = experiment::ready(fmu, &experiment::strict())?;
        experiment::simulate(&mut two, 0, STEPS)?;
        experiment::simulate(&mut one, 0, STEPS)?;
        let same = experiment::outputs(&mut one)? == experiment::outputs(&mut two)?;
        findings.expect(same, "two instances of one name do not disturb each other");
    }
    Ok(())
}

fn text(messages: &[LogMessage]) -> String {
    messages.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// Locales with a decimal comma.
const COMMA_LOCALES: [&str; 6] =
    ["de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8", "ru_RU.UTF-8", "German_Germany.1252"];

/// Simulation tools set the locale of the whole process; a number in XML or TOML keeps its point.
pub(crate) fn locale(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let Some(name) = COMMA_LOCALES.into_iter().find(|name| crate::set_locale(name)) else {
        let names = COMMA_LOCALES.join(", ");
        findings.skipped(format!("comma locale: this computer has none of {names}"));
        return Ok(());
    };
    let what = format!("runs under {name} to the same bits");
    findings.expect_alike(fmu, &experiment::strict(), &expected, &what);
    crate::set_locale("C");
    Ok(())
}

/// Simulations on threads at the same time.
pub(crate) fn threads(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    if fmu.co_simulation()?.can_be_instantiated_only_once_per_process {
        findings.skipped("it allows one instance a process only");
        return Ok(());
    }
    const ROUNDS: usize = 8;
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let simulations = std::thread::scope(|scope| {
        let simulate = || {
            (0..ROUNDS).map(|_| experiment::short_simulation(fmu, &experiment::strict())).collect::<Vec<_>>()
        };
        let handles = [scope.spawn(simulate), scope.spawn(simulate)];
        handles.into_iter().flat_map(|handle| handle.join().unwrap_or_default()).collect::<Vec<_>>()
    });
    let text = format!("{} simulations on two threads at a time come to their end", 2 * ROUNDS);
    findings.expect(simulations.len() == 2 * ROUNDS, text);
    let mut alike = true;
    for simulation in simulations {
        alike &= simulation? == expected;
    }
    findings.expect(alike, "each gives the bits of a simulation alone");

    // An instance may move from thread to thread between calls.
    let mut instance = experiment::ready(fmu, &experiment::strict())?;
    experiment::simulate(&mut instance, 0, STEPS / 2)?;
    let moved = std::thread::scope(|scope| {
        let handle = scope.spawn(move || {
            experiment::simulate(&mut instance, STEPS / 2, STEPS)?;
            experiment::outputs(&mut instance)
        });
        handle.join().ok()
    });
    let same = matches!(moved, Some(Ok(bits)) if bits == expected);
    findings.expect(same, "an instance runs on when another thread takes it over");
    Ok(())
}

/// Instances beside and after one another.
pub(crate) fn instances(findings: &mut Findings<'_>) -> Outcome {
    let fmu = findings.fmu;
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    if fmu.co_simulation()?.can_be_instantiated_only_once_per_process {
        findings.skipped("beside one another: it allows one instance a process only");
    } else {
        let mut fleet = Vec::new();
        for _ in 0..16 {
            fleet.push(experiment::ready(fmu, &experiment::strict())?);
        }
        // Step by step in turn, so that anything they share shows.
        for k in 0..STEPS {
            for instance in &mut fleet {
                experiment::simulate(instance, k, k + 1)?;
            }
        }
        let mut alike = true;
        for instance in &mut fleet {
            alike &= experiment::outputs(instance)? == expected;
        }
        findings.expect(alike, "16 instances stepped in turn give the bits of one");
    }
    for _ in 0..100 {
        drop(Instance::new(fmu, "probe", &InstanceOptions::default())?);
    }
    let after = experiment::short_simulation(fmu, &experiment::strict())?;
    findings.expect(after == expected, "after 100 instances came and went it runs as before");
    Ok(())
}
