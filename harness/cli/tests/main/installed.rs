//! A program with its library beside it works in any folder, and knows a file's model.

use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
};

use crate::{library, shown, text};

/// Runs the program of this prefix in a folder, without any of the variables that tests set.
fn run_in(folder: &Path, program: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).env_clear();
    if let Some(path) = std::env::var_os("PATH") {
        command.env("PATH", path);
    }
    let output = command.output().unwrap();
    (output.status.code(), text(&output))
}

#[test]
fn a_program_with_its_library_beside_it_works_in_an_empty_folder() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    for folder in ["prefix/bin", "prefix/lib/heliotorque", "elsewhere", "links"] {
        fs::create_dir_all(at(folder)).unwrap();
    }
    let name = format!("heliotorque{}", std::env::consts::EXE_SUFFIX);
    let program = at("prefix/bin").join(&name);
    fs::copy(env!("CARGO_BIN_EXE_heliotorque"), &program).unwrap();
    let folder = at("elsewhere");
    let resources = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fmu-src/resources"));
    for file in ["ace.toml", "messenger.toml"] {
        fs::copy(resources.join(file), folder.join(file)).unwrap();
    }
    // Alone it says what is missing and what helps.
    let (status, reported) = run_in(&folder, &program, &["check", "ace.toml"]);
    assert!(
        status == Some(2) && reported.contains("--template") && reported.contains("xtask install"),
        "{reported}"
    );
    let own = at("prefix/lib/heliotorque").join(library.file_name().unwrap());
    fs::copy(&library, &own).unwrap();
    let works = |arguments: &[&str], expected: &str| {
        let (status, reported) = run_in(&folder, &program, arguments);
        assert!(status == Some(0) && reported.contains(expected), "{arguments:?}: {reported}");
    };
    works(&["check", "ace.toml"], "ok for SpinPlant");
    works(&["check", "messenger.toml"], "ok for MomentumPlant");
    // The file says which model.
    works(&["pack", "--spacecraft", "ace.toml", "--name", "Ace"], "Ace.fmu: Ace, ");
    works(&["pack", "--spacecraft", "messenger.toml"], "MomentumPlant.fmu: MomentumPlant, ");
    works(&["pack", "--model", "Guidance"], "Guidance.fmu: Guidance, ");
    works(&["info", "Ace.fmu", "--only", "burn.count"], "burn.count");
    works(&["run", "Ace.fmu", "--stop", "60", "--output", "ace.csv"], "");
    works(&["plan", "spin", "--template", "Ace.fmu"], "Re-simulated through Ace.fmu");
    // A shipped FMU is found by its name, and where it stands in the project; what is here comes first.
    fs::rename(folder.join("Guidance.fmu"), own.with_file_name("Shipped.fmu")).unwrap();
    for name in ["Shipped.fmu", "dist/Shipped.fmu"] {
        works(&["info", name, "--only", "keepIn.azimuth"], "Shipped.fmu is not here: ");
        works(&["check", name, "--static"], "lib/heliotorque");
        works(&["run", name, "--stop", "10", "--output", "flown.csv"], "lib/heliotorque");
        works(&["wire", name, "--output", "alone.ssp"], "lib/heliotorque");
    }
    for name in ["other/Shipped.fmu", "../dist/Shipped.fmu", "Absent.fmu"] {
        let (status, reported) = run_in(&folder, &program, &["info", name]);
        assert!(
            status == Some(2) && reported.contains(name) && !reported.contains("is not here"),
            "{reported}"
        );
    }
    fs::write(folder.join("Shipped.fmu"), "not an archive").unwrap();
    let (status, reported) = run_in(&folder, &program, &["info", "Shipped.fmu"]);
    assert!(status == Some(2) && !reported.contains("is not here"), "{reported}");
    // What stands in the folder by chance is not taken.
    fs::create_dir(folder.join("dist")).unwrap();
    fs::write(folder.join("dist/MomentumPlant.fmu"), "not an archive").unwrap();
    works(&["check", "messenger.toml"], "ok for MomentumPlant");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&program, at("links").join(&name)).unwrap();
        let (status, reported) = run_in(&folder, &at("links").join(&name), &["check", "ace.toml"]);
        assert!(status == Some(0), "{reported}");
    }
}

#[test]
fn a_file_that_is_wrong_is_judged_as_what_it_is() {
    let Some((scratch, template)) = crate::template() else { return };
    let at = |name: &str| scratch.path().join(name);
    let ace = include_str!("../../../../fmu-src/resources/ace.toml");
    let wrong = at("wrong.toml");
    fs::write(&wrong, ace.replace("resolution_s = 0.032", "resolution_s = -1.0")).unwrap();
    let output = at("x.fmu");
    let pack =
        ["pack", "--template", shown(&template), "--output", shown(&output), "--spacecraft", shown(&wrong)];
    let reported = crate::run(&pack, 2);
    assert!(reported.contains("thrusters.resolution_s") && !reported.contains("unknown"), "{reported}");
    fs::write(&wrong, ace).unwrap();
    assert!(crate::run(&pack, 0).contains("x.fmu: SpinPlant, "));
    // Start values of another model of the same kind of file do not choose that model.
    let messenger = include_str!("../../../../fmu-src/resources/messenger.toml");
    fs::write(&wrong, format!("{messenger}\n[start.MomentumPlant]\n\"pointing.scenario\" = \"nadir\"\n"))
        .unwrap();
    let reported = crate::run(&pack, 2);
    assert!(reported.contains("pointing.scenario"), "{reported}");
}
