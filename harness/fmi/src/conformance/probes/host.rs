//! The FMU's host: callbacks, paths, names, locale, threads.

use crate::{Callbacks, Error, Fmu, Instance, InstanceOptions, LogMessage, Resources, Status, copy_folder};

use crate::conformance::{
    Finding,
    experiment::{self, Bits, STEPS},
    probe::{Findings, Trial},
    verdict::verdict,
};

/// The callbacks' struct ends with `fmi2Instantiate` (2.0.5); memory functions may be NULL if the FMU declares it.
pub(crate) fn callbacks(fmu: &Fmu) -> Findings {
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let may_be_null = fmu.co_simulation()?.can_not_use_memory_management_functions;
    let mut findings = Vec::new();
    let mut try_with = |what: &str, callbacks: Callbacks| {
        let options = InstanceOptions { callbacks, ..experiment::strict() };
        findings.push(runs_alike(fmu, &options, &expected, what));
    };
    try_with(
        "runs on after the struct of callbacks is overwritten",
        Callbacks { overwritten: true, ..Callbacks::default() },
    );
    if may_be_null {
        try_with(
            "runs with NULL for allocateMemory and freeMemory, as it claims",
            Callbacks { null_memory: true, ..Callbacks::default() },
        );
        try_with("runs with both", Callbacks { null_memory: true, overwritten: true });
    } else {
        findings.push(Finding::skipped("NULL memory functions: it claims to need them"));
    }
    Ok(findings)
}

/// Whether a short simulation with these options gives these bits.
fn runs_alike(fmu: &Fmu, options: &InstanceOptions, expected: &Bits, what: &str) -> Finding {
    match experiment::short_simulation(fmu, options) {
        Ok(found) => Finding::expect(found == *expected, what),
        Err(error) => Finding::bad(format!("not so: {what}\n{error}")),
    }
}

/// NULL where nothing is to be read or written.
pub(crate) fn nulls(fmu: &Fmu) -> Findings {
    let mut instance = experiment::ready(fmu, &experiment::unchecked())?;
    let state_calls = fmu.co_simulation()?.can_get_and_set_fmu_state;
    let findings = instance
        .probe_nulls()
        .into_iter()
        .filter(|(name, _)| *name != "fmi2FreeFMUstate" || state_calls)
        .map(|(name, answer)| survived(name, &format!("{name} with NULL for nothing"), "", answer))
        .collect();
    Ok(findings)
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

fn free_no_state(fmu: &Fmu, trial: &Trial) -> Findings {
    if !fmu.co_simulation()?.can_get_and_set_fmu_state {
        return Ok(vec![Finding::skipped(format!("{}: states are not claimed", trial.call))]);
    }
    let mut instance = experiment::ready(fmu, &experiment::unchecked())?;
    let answer = instance.probe_free_no_state();
    Ok(vec![survived(trial.call, trial.call, " is ignored (2.1.8)", answer)])
}

/// Good where the answer is, otherwise a note.
fn survived(call: &str, what: &str, good: &str, answer: Result<Status, String>) -> Finding {
    match answer {
        Ok(Status::Ok | Status::Warning) => Finding::good(format!("{what}{good}")),
        Ok(status) => Finding::note(format!("{what} answers {status}")),
        Err(missing) => Finding::note(format!("{call}: {missing}")),
    }
}

/// Folders that path handling stumbles over.
const STRANGE: [&str; 6] =
    ["with space", "50% off", "a+b", "{braces} #1", "Überraum λ 火星", "dots..and~tilde"];

/// Moves the FMU to strange places and runs it there.
pub(crate) fn paths(fmu: &Fmu) -> Findings {
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let mut findings = Vec::new();
    let scratch = tempfile::tempdir().map_err(|source| Error::File { path: std::env::temp_dir(), source })?;
    for name in STRANGE {
        let place = scratch.path().join(name);
        copy_folder(fmu.folder(), &place)?;
        let there = Fmu::open(&place)?;
        let what = format!("runs from a folder called {name:?}");
        findings.push(runs_alike(&there, &experiment::strict(), &expected, &what));
    }
    let own = crate::file_uri(&fmu.folder().join("resources"));
    let path = own.trim_start_matches("file://").to_owned();
    for (what, uri) in [
        ("takes file:/path", format!("file:{path}")),
        ("takes file://localhost/path", format!("file://localhost{path}")),
        ("takes a resource location with a slash at its end", format!("{own}/")),
    ] {
        let options = InstanceOptions { resources: Resources::Uri(uri), ..experiment::strict() };
        findings.push(match experiment::short_simulation(fmu, &options) {
            Ok(found) => Finding::expect(found == expected, what),
            Err(error) => Finding::note(format!("not so: {what}\n{error}")),
        });
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
        findings.push(Finding::good(format!("{runs} with {what} for the resource location, and goes on")));
    }
    Ok(findings)
}

/// GUIDs and names.
pub(crate) fn identity(fmu: &Fmu) -> Findings {
    let mut findings = Vec::new();
    for guid in ["", "{00000000-0000-0000-0000-000000000000}", "100 %s %n #r1#"] {
        let options = InstanceOptions { guid: Some(guid.to_owned()), ..experiment::unchecked() };
        findings.push(match Instance::new(fmu, "probe", &options) {
            Ok(_) => Finding::bad(format!("gives an instance for the GUID {guid:?}, which is not its own")),
            Err(Error::Call(call)) if !call.messages.is_empty() => {
                Finding::good(format!("refuses the GUID {guid:?} with the message: {}", text(&call.messages)))
            }
            Err(_) => Finding::note(format!("refuses the GUID {guid:?} without a word")),
        });
    }
    for name in ["100 % done %s %n", "#r0# and ## and #", "Überraum λ 火星", "a\tb\nc", &"long ".repeat(1000)]
    {
        let shown: String = name.chars().take(20).collect();
        let what = format!("takes the instance name {shown:?}");
        findings.push(verdict(&what, Instance::new(fmu, name, &experiment::strict()).map(|_| ())));
    }
    for name in ["", "   "] {
        let outcome = Instance::new(fmu, name, &experiment::unchecked());
        findings.push(match outcome {
            Err(_) => Finding::good(format!("refuses the instance name {name:?}")),
            Ok(_) => Finding::note(format!("takes the instance name {name:?}, which names nothing (2.1.5)")),
        });
    }
    // Two instances of one name are two instances.
    let mut one = experiment::ready(fmu, &experiment::strict())?;
    if !fmu.co_simulation()?.can_be_instantiated_only_once_per_process {
        let mut two = experiment::ready(fmu, &experiment::strict())?;
        experiment::simulate(&mut two, 0, STEPS)?;
        experiment::simulate(&mut one, 0, STEPS)?;
        let same = experiment::outputs(&mut one)? == experiment::outputs(&mut two)?;
        findings.push(Finding::expect(same, "two instances of one name do not disturb each other"));
    }
    Ok(findings)
}

fn text(messages: &[LogMessage]) -> String {
    messages.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// Locales with a decimal comma.
const COMMA_LOCALES: [&str; 6] =
    ["de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8", "ru_RU.UTF-8", "German_Germany.1252"];

/// Simulation tools set the locale of the whole process; a number in XML or TOML keeps its point.
pub(crate) fn locale(fmu: &Fmu) -> Findings {
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let Some(name) = COMMA_LOCALES.into_iter().find(|name| crate::set_locale(name)) else {
        let names = COMMA_LOCALES.join(", ");
        return Ok(vec![Finding::skipped(format!("comma locale: this computer has none of {names}"))]);
    };
    let what = format!("runs under {name} to the same bits");
    let finding = runs_alike(fmu, &experiment::strict(), &expected, &what);
    crate::set_locale("C");
    Ok(vec![finding])
}

/// Simulations on threads at the same time.
pub(crate) fn threads(fmu: &Fmu) -> Findings {
    if fmu.co_simulation()?.can_be_instantiated_only_once_per_process {
        return Ok(vec![Finding::skipped("it allows one instance a process only")]);
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
    let mut findings = vec![Finding::expect(
        simulations.len() == 2 * ROUNDS,
        format!("{} simulations on two threads at a time come to their end", 2 * ROUNDS),
    )];
    let mut alike = true;
    for simulation in simulations {
        alike &= simulation? == expected;
    }
    findings.push(Finding::expect(alike, "each gives the bits of a simulation alone"));

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
    findings.push(Finding::expect(same, "an instance runs on when another thread takes it over"));
    Ok(findings)
}

/// Instances beside and after one another.
pub(crate) fn instances(fmu: &Fmu) -> Findings {
    let expected = experiment::short_simulation(fmu, &experiment::strict())?;
    let mut findings = Vec::new();
    if fmu.co_simulation()?.can_be_instantiated_only_once_per_process {
        findings.push(Finding::skipped("beside one another: it allows one instance a process only"));
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
        findings.push(Finding::expect(alike, "16 instances stepped in turn give the bits of one"));
    }
    for _ in 0..100 {
        drop(Instance::new(fmu, "probe", &InstanceOptions::default())?);
    }
    let after = experiment::short_simulation(fmu, &experiment::strict())?;
    findings.push(Finding::expect(after == expected, "after 100 instances came and went it runs as before"));
    Ok(findings)
}
