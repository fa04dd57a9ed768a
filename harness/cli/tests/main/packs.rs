//! Archives are the same byte for byte, complete, and made anew from a template without a compiler.

use std::{fs, io::Read, path::Path};

use model_description::call_table::Function;

use crate::{built, library, packed, probe_library, run, says, shown, words};

const ACE: &str = "../../fmu-src/resources/ace.toml";

fn entries(path: &Path) -> Vec<(String, Vec<u8>)> {
    let mut zip = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    (0..zip.len())
        .map(|index| {
            let mut entry = zip.by_index(index).unwrap();
            let mut bytes = Vec::new();
            entry.read_to_end(&mut bytes).unwrap();
            (entry.name().unwrap().into_owned(), bytes)
        })
        .collect()
}

/// A text in an archive.
fn text_in(path: &Path, name: &str) -> String {
    let (_, bytes) = entries(path).into_iter().find(|(entry, _)| entry == name).expect(name);
    String::from_utf8(bytes).unwrap()
}

#[test]
fn the_same_input_gives_the_same_archive() {
    let Some((scratch, first)) = packed("AllTypes") else { return };
    let second = scratch.path().join("deeper/second.fmu");
    let library = probe_library().unwrap();
    let pack = ["pack", "--library", shown(&library), "--model", "AllTypes", "--output", shown(&second)];
    let text = run(&pack, 2);
    assert!(text.contains("there is no folder") && text.contains("see --output"), "{text}");
    fs::create_dir(scratch.path().join("deeper")).unwrap();
    run(&pack, 0);
    assert!(fs::read(&first).unwrap() == fs::read(&second).unwrap());

    let names: Vec<String> = entries(&first).into_iter().map(|(name, _)| name).collect();
    assert!(names.is_sorted(), "{names:?}");
    for expected in [
        "modelDescription.xml",
        "documentation/index.html",
        "documentation/licenses/license.txt",
        "documentation/licenses/LICENSE-APACHE.txt",
        "documentation/licenses/LICENSE-MIT.txt",
        "documentation/licenses/THIRD-PARTY.txt",
    ] {
        assert!(names.iter().any(|name| name == expected), "{expected} is missing of {names:?}");
    }
    // One library, under FMI 2.0's name of the platform.
    let libraries: Vec<_> = names.iter().filter(|name| name.starts_with("binaries/")).collect();
    let platform = fmi::platform_folders()[0];
    assert_eq!(libraries, [&format!("binaries/{platform}/AllTypes{}", std::env::consts::DLL_SUFFIX)]);
}

/// The head of a library of Windows, which is enough to tell its platform.
fn head_of_dll(path: &Path) {
    let mut bytes = vec![0; 0x400];
    bytes[..2].copy_from_slice(b"MZ");
    bytes[0x3c] = 0x80;
    bytes[0x80..0x84].copy_from_slice(b"PE\0\0");
    bytes[0x84..0x86].copy_from_slice(&0x8664_u16.to_le_bytes());
    fs::write(path, bytes).unwrap();
}

#[test]
fn libraries_of_other_platforms_stand_in_their_folders() {
    let Some(library) = probe_library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let [dll, fmu, next] = ["probe.dll", "All.fmu", "Next.fmu"].map(|name| scratch.path().join(name));
    head_of_dll(&dll);
    let pack = |libraries: &[&Path], status: i32| {
        let mut arguments = vec!["pack", "--model", "AllTypes", "--output", shown(&fmu)];
        libraries.iter().for_each(|library| arguments.extend(["--library", shown(library)]));
        run(&arguments, status)
    };
    pack(&[&library, &dll], 0);
    let binaries = |path: &Path| -> Vec<String> {
        entries(path).into_iter().map(|(name, _)| name).filter(|name| name.starts_with("binaries/")).collect()
    };
    let own = format!("binaries/{}/AllTypes{}", fmi::platform_folders()[0], std::env::consts::DLL_SUFFIX);
    assert_eq!(binaries(&fmu), [own.clone(), "binaries/win64/AllTypes.dll".to_owned()]);
    let text = run(&["info", shown(&fmu)], 0);
    says(
        &text,
        &["platforms", &format!("{}, win64", fmi::platform_folders()[0]), "PE x86-64; needs no library"],
    );
    says(&run(&["check", shown(&fmu), "--static"], 0), &["0 failed"]);

    // A template keeps them all.
    run(&["pack", "--template", shown(&fmu), "--name", "Next", "--output", shown(&next)], 0);
    assert_eq!(binaries(&next), [own.replace("AllTypes", "Next"), "binaries/win64/Next.dll".to_owned()]);

    says(&pack(&[&library, &dll, &dll], 2), &["probe.dll is for win64, as", "one a platform", "--library"]);
    // The first is loaded.
    says(&pack(&[&dll, &library], 2), &["does not load"]);
}

#[test]
fn a_library_in_the_folder_of_another_platform_is_wrong() {
    let Some((scratch, fmu)) = packed("AllTypes") else { return };
    let folder = scratch.path().join("unpacked");
    for (name, content) in entries(&fmu) {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }
    run(&["check", shown(&folder), "--static"], 0);
    let strange = folder.join("binaries/linux32");
    fs::create_dir(&strange).unwrap();
    head_of_dll(&strange.join("AllTypes.so"));
    let text = run(&["check", shown(&folder), "--static"], 1);
    says(&text, &["binaries/linux32/AllTypes.so: found PE x86-64", "allowed for it: binaries/win64/*.dll"]);
}

#[test]
fn the_page_and_the_licences_lead_to_files_that_are_there() {
    let Some((_room, path)) = packed("AllTypes") else { return };
    let all = entries(&path);
    let page = text_in(&path, "documentation/index.html");
    let links: Vec<&str> = page.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let files: Vec<&&str> = links.iter().filter(|link| !link.starts_with('#')).collect();
    assert_eq!(files, [&"licenses/license.txt"]);
    let entry = text_in(&path, "documentation/licenses/license.txt");
    let others = all.iter().filter_map(|(name, _)| name.strip_prefix("documentation/licenses/"));
    for other in others.filter(|name| *name != "license.txt") {
        assert!(entry.contains(other), "license.txt does not lead to {other}");
    }
}

#[test]
fn every_shipped_fmu_shows_a_picture() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    for name in ["MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"] {
        let all = entries(&Path::new(&dist).join(format!("{name}.fmu")));
        let picture = all.iter().find(|(entry, _)| entry == "model.png");
        assert!(picture.is_some_and(|(_, bytes)| bytes.starts_with(b"\x89PNG")), "{name} has no picture");
    }
}

#[test]
fn the_documentation_names_every_variable() {
    let Some((_room, path)) = packed("AllTypes") else { return };
    let page = text_in(&path, "documentation/index.html");
    let xml = text_in(&path, "modelDescription.xml");
    let description = model_description::parse(xml.as_bytes()).unwrap().description;
    for variable in &description.variables {
        let cell = |name: &str| format!("<td class=\"n\">{}", model_description::escape(name));
        // A vector is one row.
        let vector = variable.name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
        let row = vector.map(|(vector, _)| cell(&format!("{vector}[1")));
        let is_there = page.contains(&format!("{}</td>", cell(&variable.name)));
        assert!(is_there || row.is_some_and(|row| page.contains(&row)), "{} is missing", variable.name);
    }
    for symbol in Function::ALL.iter().map(|function| function.symbol()) {
        assert!(page.contains(symbol), "{symbol} is missing");
    }
    assert!(page.contains("Gr\u{fc}\u{df}e") && page.contains("&lt;&amp;"), "texts are escaped");
    let (opened, closed) = (page.matches("<t").count(), page.matches("</t").count());
    // Everything that begins with <t is a table, row, cell or title, and each is closed.
    assert_eq!(opened, closed);
}

#[test]
fn a_template_gives_a_new_fmu_under_its_own_name() {
    let Some((scratch, template)) = packed("AllTypes") else { return };
    let mine = scratch.path().join("Mine.fmu");
    run(&["pack", "--template", shown(&template), "--name", "Mine", "--output", shown(&mine)], 0);
    let names: Vec<String> = entries(&mine).into_iter().map(|(name, _)| name).collect();
    assert!(names.iter().any(|name| name.ends_with(&format!("/Mine{}", std::env::consts::DLL_SUFFIX))));
    let licences = names.iter().filter(|name| name.starts_with("documentation/licenses/"));
    assert_eq!(licences.count(), 4, "{names:?}");
    assert!(run(&["info", shown(&mine)], 0).contains("Mine"));
    run(&["run", shown(&mine), "--quiet"], 0);

    // A renamed template still knows its model.
    let next = scratch.path().join("Next.fmu");
    run(&["pack", "--template", shown(&mine), "--name", "Next", "--output", shown(&next)], 0);
    run(&["run", shown(&next), "--quiet"], 0);
}

#[test]
fn what_cannot_be_packed_says_why() {
    let Some(library) = probe_library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let output = scratch.path().join("x.fmu");
    let pack = |more: &[&str]| {
        let mut arguments = vec!["pack", "--library", shown(&library), "--output", shown(&output)];
        arguments.extend(more);
        run(&arguments, 2)
    };
    let text = pack(&["--model", "Warp"]);
    assert!(text.contains("Warp") && text.contains("AllTypes"), "{text}");
    assert!(pack(&["--model", "AllTypes", "--name", "my spacecraft"]).contains("no C identifier"));
    assert!(pack(&["--model", "AllTypes", "--spacecraft", "no/such.toml"]).contains("no/such.toml"));
    let toml = scratch.path().join("odd.toml");
    fs::write(&toml, "unknown_key = 1\n").unwrap();
    let text = pack(&["--model", "AllTypes", "--spacecraft", shown(&toml)]);
    assert!(text.contains("odd.toml"), "{text}");
    fs::write(&toml, b"a = 1\nb = \"\xff\"\n").unwrap();
    assert!(pack(&["--model", "AllTypes", "--spacecraft", shown(&toml)]).contains("line 2 is not UTF-8"));
    assert!(!output.exists(), "a failed pack leaves a file");

    let text =
        run(&["pack", "--library", "no-such-library.so", "--model", "M", "--output", shown(&output)], 2);
    assert!(text.contains("does not load"), "{text}");
}

#[test]
fn outputs_of_single_plates_are_added_on_request() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let shipped = "../../fmu-src/resources/messenger-thermal.toml";
    let toml = scratch.path().join("mine.toml");
    let body = fs::read_to_string(shipped).unwrap();
    fs::write(&toml, format!("per_plate_outputs = false # for now\n{body}")).unwrap();
    let pack = |spacecraft: &str, per_plate: bool, name: &str| {
        let fmu = scratch.path().join(format!("{name}.fmu"));
        let mut arguments = vec!["pack", "--library", shown(&library), "--model", "DisturbanceTorque"];
        arguments.extend(["--spacecraft", spacecraft, "--output", shown(&fmu)]);
        arguments.extend(per_plate.then_some("--per-plate"));
        run(&arguments, 0);
        (text_in(&fmu, "modelDescription.xml"), text_in(&fmu, "resources/spacecraft.toml"), fmu)
    };

    let (plain, _, _) = pack(shipped, false, "Plain");
    assert!(!plain.contains("plate[1]"));
    let (added, file, fmu) = pack(shipped, true, "Added");
    assert_eq!(file, format!("per_plate_outputs = true\n{body}"));
    for variable in ["plate[1].temperature", "plate[1].force[3]"] {
        assert!(added.contains(&format!("\"{variable}\"")), "{variable} is missing");
    }
    // Bound to the file as packed: the GUID is that of the same file given by hand.
    let by_hand = scratch.path().join("by-hand.toml");
    fs::write(&by_hand, &file).unwrap();
    assert_eq!(pack(shown(&by_hand), false, "ByHand").0, added);
    run(&["run", shown(&fmu), "--stop", "60", "--quiet"], 0);

    let (overruled, file, _) = pack(shown(&toml), true, "Overruled");
    assert_eq!(file, format!("per_plate_outputs = true # for now\n{body}"));
    assert_eq!(overruled, added);
}

#[test]
fn a_file_of_another_model_names_the_model() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let output = scratch.path().join("Ace.fmu");
    let arguments = ["pack", "--library", shown(&library), "--output", shown(&output), "--spacecraft", ACE];
    let text = run(&[&arguments[..], &["--model", "MomentumPlant"]].concat(), 2);
    assert!(text.contains("this is a file of SpinPlant: see --model") && !output.exists(), "{text}");
    run(&[&arguments[..], &["--model", "SpinPlant"]].concat(), 0);

    // The kind is right: another model of the same kind does not help.
    let file = scratch.path().join("craft.toml");
    run(&["new", "spacecraft", shown(&file)], 0);
    let wrong = fs::read_to_string(&file).unwrap().replace("\"earth\"", "\"pluto\"");
    fs::write(&file, wrong).unwrap();
    let spk = ["--library", shown(&library), "--spacecraft", shown(&file), "--model", "MomentumPlant"];
    let text = run(&[&["pack"], &spk[..], &["--output", shown(&output)]].concat(), 2);
    assert!(text.contains("orbit.center") && text.contains("pluto"), "{text}");
    assert!(!text.contains("this is a file of"), "{text}");
}

#[test]
fn models_without_outputs_of_single_plates_refuse_them() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let output = scratch.path().join("x.fmu");
    let arguments = ["pack", "--library", shown(&library), "--output", shown(&output), "--per-plate"];
    for more in [["--model", "SpinPlant"].as_slice(), &["--model", "SpinPlant", "--spacecraft", ACE]] {
        let text = run(&[&arguments, more].concat(), 2);
        assert!(text.contains("--per-plate: SpinPlant has no outputs of single plates, allowed: "), "{text}");
        assert!(text.contains("DisturbanceTorque"), "{text}");
    }
    // A model without a file would take any text.
    if let Some(probe) = probe_library() {
        let text = run(
            &words(&format!(
                "pack --library {} --model Empty --output {} --per-plate",
                shown(&probe),
                shown(&output)
            )),
            2,
        );
        says(&text, &["Empty has no outputs of single plates, allowed: none of this library"]);
    }
    // Errors in the file itself name the lines of the file itself.
    let toml = scratch.path().join("odd.toml");
    fs::write(&toml, "name = \"A\"\nwings = 2\n").unwrap();
    let text =
        run(&[&arguments[..], &["--model", "DisturbanceTorque", "--spacecraft", shown(&toml)]].concat(), 2);
    assert!(text.contains("odd.toml:2: wings"), "{text}");
    assert!(!output.exists());
}

#[test]
fn start_values_are_packed_and_simulated() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let toml = scratch.path().join("mine.toml");
    let body = fs::read_to_string("../../fmu-src/resources/messenger.toml").unwrap();
    fs::write(&toml, format!("{body}# as simulated\n\"dump.threshold\" = [4, 4, 4] # all\n")).unwrap();
    let pack = |name: &str, more: &[&str]| {
        let fmu = scratch.path().join(format!("{name}.fmu"));
        let mut arguments = vec!["pack", "--library", shown(&library), "--model", "MomentumPlant"];
        arguments.extend(["--spacecraft", shown(&toml), "--output", shown(&fmu)]);
        arguments.extend(more);
        run(&arguments, 0);
        fmu
    };
    let set = words("--set dump.threshold[2]=5 --set panel[1].sunOffset=10deg --set orbit.frame=ecliptic");
    let fmu = pack("Set", &set);
    let packed = text_in(&fmu, "resources/spacecraft.toml");
    let added =
        "\"dump.threshold[2]\" = 5.0\n\"panel[1].sunOffset\" = \"10deg\"\n\"orbit.frame\" = \"ecliptic\"\n";
    // The shipped file ends in its own `[start]`.
    let table = "# as simulated\n\"dump.threshold\" = [4, 4, 4] # all\n";
    assert_eq!(packed, format!("{body}{table}{added}"));
    let xml = text_in(&fmu, "modelDescription.xml");
    let xml = model_description::parse(xml.as_bytes()).unwrap().description;
    let start = |name: &str| {
        let variable = xml.variables.iter().find(|variable| variable.name == name).unwrap();
        model_description::value::start(variable).unwrap().to_f64()
    };
    assert_eq!([1, 2, 3].map(|i| start(&format!("dump.threshold[{i}]"))), [4.0, 5.0, 4.0]);
    assert_eq!(
        (start("panel[1].sunOffset"), start("orbit.frame")),
        (10.0 / (180.0 / std::f64::consts::PI), 4.0)
    );

    // It runs as the unset one does with the same values set.
    let simulate = |fmu: &Path, more: &[&str]| {
        let csv = scratch.path().join("simulation.csv");
        let mut arguments = vec!["run", shown(fmu), "--stop", "20d", "--quiet", "--output", shown(&csv)];
        arguments.extend(more);
        run(&arguments, 0);
        fs::read_to_string(&csv).unwrap()
    };
    let plain = pack("Plain", &[]);
    assert_eq!(simulate(&fmu, &[]), simulate(&plain, &set));
    assert_ne!(simulate(&fmu, &[]), simulate(&plain, &[]));
    run(&["check", shown(&fmu)], 0);
}

#[test]
fn start_values_that_nothing_takes_are_refused() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let output = scratch.path().join("x.fmu");
    let pack = |model: &str, more: &[&str]| {
        let arguments = ["pack", "--library", shown(&library), "--model", model, "--output", shown(&output)];
        let text = run(&[&arguments[..], more].concat(), 2);
        assert!(!output.exists());
        text
    };
    let text = pack("MomentumPlant", &["--set", "orbit.center=pluto"]);
    assert!(text.contains("--set orbit.center=pluto: ") && text.contains("mercury (1), sun (2)"), "{text}");
    let text = pack("MomentumPlant", &["--set", "orbit.step=2d"]);
    assert!(text.contains("orbit.step: found 2d, allowed: a number from 1 to 86400 s"), "{text}");
    let text = pack("MomentumPlant", &["--set", "orbit.centre=sun"]);
    assert!(text.contains("near it: orbit.center"), "{text}");
    let text = pack("MomentumPlant", &["--set", "torque.total=1,2,3"]);
    assert!(text.contains("found the output torque.total[1], allowed: a parameter or an input"), "{text}");
    let toml = scratch.path().join("mine.toml");
    let body = fs::read_to_string("../../fmu-src/resources/messenger.toml").unwrap();
    fs::write(&toml, format!("{body}\"orbit.centre\" = \"sun\"\n")).unwrap();
    let line = body.lines().count() + 1;
    let text = pack("MomentumPlant", &["--spacecraft", shown(&toml)]);
    says(&text, &[&format!("mine.toml:{line}: start.\"orbit.centre\": found the unknown name")]);
    if let Some(probe) = probe_library() {
        let arguments = ["pack", "--library", shown(&probe), "--model", "Empty", "--output", shown(&output)];
        let text = run(&[&arguments[..], &["--set", "a=1"]].concat(), 2);
        assert!(text.contains("--set a=1: Empty reads no file"), "{text}");
    }
}

/// A map of the planet has an effect in one model and by one option; elsewhere it is reported.
#[test]
fn a_map_that_nothing_reads_is_reported() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let (toml, output) = (scratch.path().join("mapped.toml"), scratch.path().join("mapped.fmu"));
    let body = fs::read_to_string("../../fmu-src/resources/messenger-thermal.toml").unwrap();
    let map = "[planet_map]\ndiffuse_reflectivity = [[0.1, 0.2]]\nemissivity = [[0.9, 0.9]]\ntemperature_k = [[100, 600]]\n";
    fs::write(&toml, format!("{body}{map}")).unwrap();
    let pack = |model: &str, more: &[&str]| {
        let files = ["--spacecraft", shown(&toml), "--output", shown(&output)];
        let arguments = ["pack", "--library", shown(&library), "--model", model];
        run(&[&arguments[..], &files, more].concat(), 0)
    };
    let reported = pack("MomentumPlant", &[]);
    says(
        &reported,
        &["warning: [planet_map] is without effect in MomentumPlant; DisturbanceTorque takes it"],
    );
    let reported = pack("DisturbanceTorque", &[]);
    assert!(reported.contains("warning: [planet_map] has an effect in DisturbanceTorque with"), "{reported}");
    let reported = pack("DisturbanceTorque", &["--set", "planetLight.method=map"]);
    assert!(!reported.contains("warning"), "{reported}");
}

#[test]
fn a_downlink_for_ever_is_warned_of_by_every_command_and_the_log() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("busy.toml");
    let windows = "[downlinks]\nstart = \"20 %\"\nstop = \"130 %\"\nevery = 1\n\
                   [[antennas]]\nname = \"dish\"\nazimuth_deg = [-180, 180]\nbeam_deg = [3, 3]\n";
    let text = include_str!("../../../../docs/src/tutorial/venus.toml");
    fs::write(&file, format!("{text}\n{windows}")).unwrap();
    let fmu = scratch.path().join("busy.fmu");
    let pack =
        ["pack", "--library", shown(&library), "--model", "MomentumPlant", "--spacecraft", shown(&file)];
    let always = ["warning", "guided.downlinkStart", "always open"];
    says(&run(&[&pack[..], &["--output", shown(&fmu)]].concat(), 0), &always);
    says(&run(&["check", shown(&file), "--template", shown(&fmu)], 0), &always);
    let simulated =
        run(&["run", shown(&fmu), "--stop", "1h", "--step", "10min", "--record", "sun.elevation"], 0);
    says(&simulated, &always);
    // By a value of the run alone, whatever the strategy.
    let rare =
        ["--set", "guided.downlinkEvery=2", "--stop", "1h", "--step", "10min", "--record", "sun.elevation"];
    let silent = run(&[&["run", shown(&fmu)][..], &rare].concat(), 0);
    assert!(!silent.contains("always open"), "{silent}");
    let sets = [
        "--set",
        "guided.downlinkEvery=2",
        "--set",
        "guided.downlinkEnd=1d",
        "--stop",
        "1h",
        "--step",
        "10min",
    ];
    says(&run(&[&["run", shown(&fmu), "--record", "sun.elevation"][..], &sets].concat(), 0), &always);
}
