//! No command loads a library in its own process.

use super::*;

#[test]
fn no_command_loads_a_library_in_its_own_process() {
    for (behaviour, expected) in [
        ("EXITS", "loading the shared library: the process ended: it exited with status 0"),
        ("LIES", "loading the shared library: the process ended: it exited with status 0"),
        ("CRASHES", "loading the shared library: the process ended: signal 11 (segmentation fault)"),
        ("ABORTS", "loading the shared library: the process ended: signal 6 (abort)"),
        ("ALLOCATES", "loading the shared library: the process ended: signal 6 (abort)"),
        ("SLEEPS", "hangs: "),
        ("PRINTS", "hangs: "),
    ] {
        let Some(scratch) = hostile(behaviour, "AT_LOADING") else { return };
        let Some(commands) = commands_that_load(&scratch) else { return };
        for words in commands {
            let mut command = loading(&scratch, &words);
            command.args(["--timeout", "0.4s"]);
            let output = start_to_file(&scratch, command);
            let printed = text(&output);
            assert_eq!(output.status.code(), Some(2), "{behaviour}, {words:?}: {printed}");
            let named =
                printed.lines().filter(|line| line.contains("heliotorque: ") && line.contains(expected));
            assert_eq!(named.count(), 1, "{behaviour}, {words:?}: {printed}");
            assert!(printed.len() < 3 << 20, "{behaviour}, {words:?}: {} bytes", printed.len());
            for name in ["out.fmu", "out.csv", "out.toml", "out.svg"] {
                assert!(!scratch.path().join(name).exists(), "{behaviour}, {words:?}");
            }
            nothing_left(&scratch);
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_every_command_that_loads_a_library_that_hangs() {
    let Some(scratch) = hostile("SLEEPS", "AT_LOADING") else { return };
    let Some(commands) = commands_that_load(&scratch) else { return };
    for words in commands {
        let child = start(loading(&scratch, &words));
        until(|| processes(scratch.path()).len() >= 2);
        signal(&child, "INT");
        let raised = Instant::now();
        let output = wait(child);
        assert_eq!(output.status.code(), Some(130), "{words:?}: {}", text(&output));
        assert!(raised.elapsed() < Duration::from_secs(1), "{words:?}: {:?}", raised.elapsed());
        nothing_left(&scratch);
    }
}

#[test]
fn a_library_that_hangs_or_exits_while_it_describes_its_models_is_named_with_the_call() {
    for (behaviour, expected) in [
        ("SLEEPS", "hangs: the call did not return within 0.3 s (see --timeout)"),
        ("EXITS", "the process ended"),
    ] {
        let Some(scratch) = hostile(behaviour, "IN_DESCRIBE") else { return };
        let fmu = scratch.path().join("fmu");
        for name in ["pack", "map"] {
            let more: &[&str] = if name == "pack" { &["--template", shown(&fmu)] } else { &[shown(&fmu)] };
            let describing = program(&scratch, &[&[name, "--timeout", "0.3s"], more].concat());
            let output = start_to_file(&scratch, describing);
            let printed = text(&output);
            assert_eq!(output.status.code(), Some(2), "{behaviour}, {name}: {printed}");
            assert!(
                printed.contains(&format!("fmi_export_describe: {expected}")),
                "{behaviour}, {name}: {printed}"
            );
            nothing_left(&scratch);
        }
    }
}

#[test]
fn what_a_template_prints_moves_no_cursor() {
    let Some(scratch) = hostile("STAINS", "AT_LOADING") else { return };
    let Some(commands) = commands_that_load(&scratch) else { return };
    for words in commands {
        let printed = text(&start_to_file(&scratch, loading(&scratch, &words)));
        assert!(printed.contains("\\u{1b}[2Jcleared\\u{7}"), "{words:?}: {printed}");
        assert!(!printed.contains(is_control), "{words:?}: {printed:?}");
    }
}
