//! `check` passes what is right and names what is wrong, by line where there is one.

use std::{fs, io::Write, path::Path, process::Command, time::Instant};

use crate::{built, is_long, library, packed, packed_from, run, says, shown};

const RESOURCES: &str = "../../fmu-src/resources";

/// Unpacks the FMU and changes its XML.
fn changed(fmu: &Path, from: &str, to: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fmi::unpack(fmu, folder.path(), fmi::ArchiveLimits::default()).unwrap();
    let path = folder.path().join("modelDescription.xml");
    let xml = fs::read_to_string(&path).unwrap();
    assert!(xml.contains(from), "the XML has no {from}");
    fs::write(&path, xml.replacen(from, to, 1)).unwrap();
    folder
}

#[test]
fn our_own_fmus_pass() {
    for model in ["Empty", "AllTypes"] {
        let Some((_room, fmu)) = packed(model) else { return };
        let text = run(&["check", shown(&fmu), "--verbose"], 0);
        assert!(text.contains("0 warnings, 0 failed"), "{text}");
        says(
            &text,
            &[
                "exports all 34 functions",
                "overwritten",
                "runs from a folder called \"50% off\"",
                "two threads",
            ],
        );
    }
}

#[test]
fn a_comma_locale_is_tried_where_there_is_one() {
    let there = std::env::var_os("LOCPATH")
        .is_some_and(|folder| Path::new(&folder).join("de_DE.UTF-8").join("LC_NUMERIC").exists());
    if !there {
        assert!(std::env::var_os("CI").is_none(), "LOCPATH holds no de_DE.UTF-8");
        eprintln!("skipped: LOCPATH holds no de_DE.UTF-8: run `cargo xtask test`");
        return;
    }
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let text = run(&["check", shown(&fmu), "--probe", "locale", "--verbose"], 0);
    assert!(text.contains("runs under de_DE.UTF-8 to the same bits"), "{text}");
    assert!(text.contains("0 skipped"), "{text}");
}

#[test]
fn every_shipped_fmu_passes() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    let entries = fs::read_dir(dist).unwrap().map(|entry| entry.unwrap().path());
    let fmus: Vec<_> = entries.filter(|path| path.extension().is_some_and(|it| it == "fmu")).collect();
    assert!(!fmus.is_empty(), "nothing is packed");
    for fmu in fmus {
        // Through every call the quickest alone, the others in the tests' long extent: those of the four models are so in
        // `tests/suite/conformance.rs`.
        let is_quick = fmu.file_stem().is_some_and(|stem| stem == "SpinPlant");
        let options = if is_quick || is_long() { &[][..] } else { &["--static"] };
        let text = run(&[&["check", shown(&fmu)][..], options].concat(), 0);
        assert!(text.contains("0 warnings, 0 failed"), "{text}");
    }
}

#[test]
fn what_the_description_gets_wrong_is_named_with_its_line() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "stepSize=\"", "stepSize=\"-");
    let text = run(&["check", shown(folder.path()), "--static"], 1);
    assert!(text.contains("failed") && text.contains("line "), "{text}");

    let folder = changed(&fmu, "start=\"1.5\"", "start=\"2.75\"");
    let text = run(&["check", shown(folder.path()), "--probe", "values"], 1);
    assert!(text.contains("parameter.real starts at 1.5, its XML has 2.75"), "{text}");
}

#[test]
fn a_capability_that_is_only_claimed_is_found() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "guid=\"{", "guid=\"{0");
    let text = run(&["check", shown(folder.path()), "--probe", "simulation"], 1);
    assert!(text.contains("gave no instance") && text.contains("GUID"), "{text}");

    let folder = changed(&fmu, "maxOutputDerivativeOrder=\"1\"", "maxOutputDerivativeOrder=\"7\"");
    let text = run(&["check", shown(folder.path()), "--probe", "derivatives"], 1);
    assert!(text.contains("not so: gives output derivatives of order 7"), "{text}");
}

#[test]
fn a_missing_library_and_strange_files_are_found() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "modelName", "modelName");
    fs::remove_dir_all(folder.path().join("binaries")).unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    fs::create_dir(folder.path().join("licenses")).unwrap();
    fs::create_dir(folder.path().join("terminalsAndIcons")).unwrap();
    fs::create_dir_all(folder.path().join("extra")).unwrap();
    fs::remove_dir_all(folder.path().join("documentation/licenses")).unwrap();
    let text = run(&["check", shown(folder.path())], 1);
    says(
        &text,
        &[
            "no shared library for this computer",
            "warning notes.txt is none of",
            "warning licenses is none of",
            "warning has no documentation/licenses/license.txt or",
        ],
    );
    assert!(text.contains("3 warnings"), "{text}");
}

/// Packs an unpacked FMU again; `name` gives each entry's path.
fn zipped(folder: &Path, into: &Path, name: impl Fn(String) -> String) {
    let mut zip = zip::ZipWriter::new(fs::File::create(into).unwrap());
    let mut open = vec![folder.to_owned()];
    while let Some(here) = open.pop() {
        for entry in fs::read_dir(here).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
                continue;
            }
            let relative = path.strip_prefix(folder).unwrap().to_str().unwrap().replace('\\', "/");
            zip.start_file(name(relative), zip::write::SimpleFileOptions::default()).unwrap();
            zip.write_all(&fs::read(&path).unwrap()).unwrap();
        }
    }
    zip.finish().unwrap();
}

#[test]
fn backslashes_in_the_archive_are_wrong() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "modelName", "modelName");
    let again = scratch.path().join("again.fmu");
    zipped(folder.path(), &again, |name| name);
    run(&["check", shown(&again), "--static"], 0);
    zipped(folder.path(), &again, |name| name.replace("resources/", "resources\\"));
    let text = run(&["check", shown(&again), "--static"], 1);
    let expected = "failed  the path \"resources\\\\all-types.toml\" has a backslash";
    assert!(text.contains(expected) && text.contains("1 failed"), "{text}");
}

#[test]
fn a_listed_source_file_that_is_not_there_is_wrong() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let listed = |name: &str| {
        let files =
            format!("<CoSimulation><SourceFiles><File name=\"{name}\"/></SourceFiles></CoSimulation>");
        let folder = changed(&fmu, "modelName", "modelName");
        let path = folder.path().join("modelDescription.xml");
        let xml = fs::read_to_string(&path).unwrap();
        let (head, tail) = xml.split_once("<CoSimulation").unwrap();
        let (flags, tail) = tail.split_once("/>").unwrap();
        let element = files.replacen("<CoSimulation", &format!("<CoSimulation{flags}"), 1);
        fs::write(&path, format!("{head}{element}{tail}")).unwrap();
        fs::create_dir_all(folder.path().join("sources/deep")).unwrap();
        fs::write(folder.path().join("sources/deep/there.c"), "").unwrap();
        folder
    };
    run(&["check", shown(listed("deep/there.c").path()), "--static"], 0);
    for name in ["there.c", "deep", "../modelDescription.xml", "/etc/hostname"] {
        let text = run(&["check", shown(listed(name).path()), "--static"], 1);
        assert!(text.contains(&format!("failed  CoSimulation/SourceFiles lists {name:?}")), "{text}");
    }
}

#[test]
fn an_unknown_attribute_is_wrong() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "modelName=", "clocks=\"1\" modelName=");
    let text = run(&["check", shown(folder.path()), "--static"], 1);
    assert!(text.contains("failed  line 2: error [unknown-attribute]"), "{text}");
}

/// The C sources of the tests.
const C: &str = "../../tests/c";

/// An FMU in C that does not check its arguments; see its source.
fn unguarded() -> Option<tempfile::TempDir> {
    let folder = tempfile::tempdir().unwrap();
    let platform = folder.path().join("binaries").join(fmi::platform_folders()[0]);
    let sources = folder.path().join("sources");
    fs::create_dir_all(&platform).unwrap();
    fs::create_dir_all(&sources).unwrap();
    fs::copy(format!("{C}/unguarded.xml"), folder.path().join("modelDescription.xml")).unwrap();
    fs::copy(format!("{C}/unguarded.c"), sources.join("unguarded.c")).unwrap();
    let compiled = Command::new("gcc")
        .args(["-std=c11", "-O2", "-Wall", "-Werror", "-shared", "-fPIC", "-fvisibility=hidden"])
        .arg(sources.join("unguarded.c"))
        .arg("-o")
        .arg(platform.join(format!("Unguarded{}", std::env::consts::DLL_SUFFIX)))
        .arg("-lm")
        .status();
    match compiled {
        Ok(status) => assert!(status.success()),
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "gcc: {error}");
            eprintln!("skipped: gcc: {error}");
            return None;
        }
    }
    Some(folder)
}

#[test]
fn an_fmu_that_hangs_at_invalid_times_and_crashes_at_null_is_checked_to_the_end() {
    let Some(folder) = unguarded() else { return };
    let began = Instant::now();
    let text = run(&["check", shown(folder.path()), "--verbose"], 0);
    assert!(began.elapsed().as_secs() < 120, "{text}");
    for what in ["a step of NaN", "an infinite step", "a step from an infinite time"] {
        let found = format!("warning fmi2DoStep, {what}: ");
        assert!(text.contains(&found), "{text} lacks {found}");
    }
    // It reads through the pointer that the standard may mean where it says that a null pointer is ignored (2.1.8).
    let found = "warning fmi2FreeFMUstate(instance, NULL), the pointer to the state is NULL: ";
    assert!(text.contains(found), "{text}");
    assert!(text.contains(" 0 failed"), "{text}");
    // What follows the trials in the report is there.
    says(&text, &["refuses a step backwards", "sources/unguarded.c is there", "100 instances came and went"]);
    // A factor for an Integer output has no meaning, which is no fault.
    assert!(text.contains("warning [dependency-kind-real] ModelStructure/Outputs entry 2 (`m`)"), "{text}");
}

#[test]
fn an_fmu_that_dies_is_a_finding() {
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "modelName", "modelName");
    let platform = folder.path().join("binaries").join(fmi::platform_folders()[0]);
    let library = platform.join(format!("AllTypes{}", std::env::consts::DLL_SUFFIX));
    let bytes = fs::read(&library).unwrap();
    fs::write(&library, &bytes[..bytes.len() / 3]).unwrap();
    let text = run(&["check", shown(folder.path())], 1);
    assert!(text.contains("failed  "), "{text}");
}

/// A shipped model with a shipped spacecraft, unpacked.
fn shipped(model: &str, spacecraft: &str) -> Option<tempfile::TempDir> {
    let toml = format!("{RESOURCES}/{spacecraft}");
    let (scratch, fmu) = packed_from(&library()?, model, "x.fmu", &["--spacecraft", &toml])?;
    fmi::unpack(&fmu, &scratch.path().join("x"), fmi::ArchiveLimits::default()).unwrap();
    Some(scratch)
}

#[test]
fn a_spacecraft_is_judged_by_the_model_it_is_for() {
    let Some(scratch) = shipped("MomentumPlant", "messenger.toml") else { return };
    let template = scratch.path().join("x.fmu");
    let toml = scratch.path().join("my.toml");
    let check = |text: &str| {
        fs::write(&toml, text).unwrap();
        run(&["check", shown(&toml), "--template", shown(&template)], 1)
    };
    let ace = fs::read_to_string(format!("{RESOURCES}/ace.toml")).unwrap();
    let line = 1 + ace[..ace.find("dry_mass_kg").unwrap()].matches('\n').count();
    let text = check(
        &ace.replace("dry_mass_kg = 562.0", "dry_mass_kg = -1").replace("sectors = 16384", "sektors = 1"),
    );
    says(&text, &[&format!("my.toml:{line}: mass_properties.dry_mass_kg: found -1, allowed: ")]);
    assert!(text.contains("2 problems, judged as a file of SpinPlant"), "{text}");
    // Cut off at its end, it is still a spinner's.
    assert!(check(&format!("{ace}\n[[[")).contains("1 problem, judged as a file of SpinPlant"));
    // Of the models that take the same file, the template's.
    let orbiter = fs::read_to_string(format!("{RESOURCES}/messenger-thermal.toml")).unwrap();
    let text = check(&orbiter.replace("mass_kg = 700", "mass_kg = -700"));
    assert!(text.contains("1 problem, judged as a file of MomentumPlant"), "{text}");
    assert!(check("name = \"A\"\n").contains("judged as a file of MomentumPlant"));
    fs::write(&toml, "").unwrap();
    let text = run(&["check", shown(&toml), "--template", shown(&template)], 2);
    assert!(text.contains("found an empty file, allowed: a spacecraft, "), "{text}");
}

#[test]
fn a_spacecraft_changed_after_packing_is_the_first_thing_reported() {
    for (model, spacecraft, from, to, expected) in [
        ("MomentumPlant", "messenger", "mass_kg = 700", "mass_kg = 701", "MomentumPlant has GUID {"),
        ("MomentumPlant", "messenger", "mass_kg = 700", "mass_kg = -7", "mass_properties.mass_kg: found -7"),
        ("MomentumPlant", "messenger-thermal", "mass_kg = 700", "mass_kg = 701", "MomentumPlant has GUID {"),
        ("MomentumPlant", "messenger-thermal", "mass_kg = 700", "mas_kg = 700", "`mas_kg`"),
        ("SpinPlant", "ace", "dry_mass_kg = 562", "dry_mass_kg = 563", "SpinPlant has GUID {"),
    ] {
        let Some(scratch) = shipped(model, &format!("{spacecraft}.toml")) else { return };
        let folder = scratch.path().join("x");
        let toml = folder.join("resources/spacecraft.toml");
        let text = fs::read_to_string(&toml).unwrap();
        assert!(text.contains(from), "{spacecraft}");
        fs::write(&toml, text.replacen(from, to, 1)).unwrap();
        let text = run(&["run", shown(&folder)], 2);
        let changed = text.find("spacecraft.toml").unwrap();
        assert!(text[changed..].contains("was changed after packing") && text.contains(expected), "{text}");
        // Models for another kind of file say nothing of this one.
        let other = if model == "SpinPlant" { "MomentumPlant" } else { "SpinPlant" };
        assert!(!text.contains(other), "{text}");
        assert!(text.lines().count() < 5, "{text}");
    }
    let Some(scratch) = shipped("MomentumPlant", "messenger.toml") else { return };
    let folder = scratch.path().join("x");
    fs::remove_file(folder.join("resources/spacecraft.toml")).unwrap();
    let text = run(&["run", shown(&folder)], 2);
    assert_eq!(text.matches("resources").count(), 1, "{text}");
}

#[test]
fn a_reference_table_with_names_of_another_fmi_is_a_note_and_the_rest_is_compared() {
    const REFERENCE: &str = "extra/org.fmi-standard.fmi-ls-ref";
    const LIST: &str =
        "<fmiReferences><Related type=\"text/csv\" source=\"ref.csv\" role=\"result\"/></fmiReferences>";
    let Some((_room, fmu)) = packed("AllTypes") else { return };
    let folder = changed(&fmu, "modelName", "modelName");
    let reference = folder.path().join(REFERENCE);
    let check = |table: &str, status: i32| {
        fs::create_dir_all(&reference).unwrap();
        fs::write(reference.join("fmi-ls-manifest.xml"), LIST).unwrap();
        fs::write(reference.join("ref.csv"), table).unwrap();
        run(&["check", shown(folder.path()), "--probe", "reference"], status)
    };
    let name = "role.outputConstant";
    let text = check(&format!("time,{name},Float32_output,Int8_output\n0,42,1,1\n1,42,1,1\n"), 0);
    says(&text, &["2 of 3 columns are no variables of this FMU", "\"Float32_output\""]);
    assert!(text.contains("1 warnings, 0 failed"), "{text}");
    // What it has is compared.
    let text = check(&format!("time,{name},Int8_output\n0,41,1\n1,41,1\n"), 1);
    assert!(text.contains(&format!("ref.csv: {name} at 0 s: found 42, allowed: 41")), "{text}");
}
