//! Archives are the same byte for byte, complete, and made anew from a template without a compiler.

use std::{fs, io::Read, path::Path};

use crate::{library, packed, probe_library, run, shown};

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

#[test]
fn the_same_input_gives_the_same_archive() {
    let Some((room, first)) = packed("AllTypes") else { return };
    let second = room.path().join("deeper/second.fmu");
    let library = probe_library().unwrap();
    let pack = ["pack", "--library", shown(&library), "--model", "AllTypes", "--output", shown(&second)];
    let text = run(&pack, 1);
    assert!(text.contains("there is no folder") && text.contains("see --output"), "{text}");
    fs::create_dir(room.path().join("deeper")).unwrap();
    run(&pack, 0);
    assert!(fs::read(&first).unwrap() == fs::read(&second).unwrap());

    let names: Vec<String> = entries(&first).into_iter().map(|(name, _)| name).collect();
    assert!(names.is_sorted(), "{names:?}");
    for wanted in [
        "modelDescription.xml",
        "documentation/index.html",
        "licenses/LICENSE-MIT.txt",
        "licenses/THIRD-PARTY.txt",
    ] {
        assert!(names.iter().any(|name| name == wanted), "{wanted} is missing of {names:?}");
    }
    let libraries = names.iter().filter(|name| name.starts_with("binaries/") && name.contains("/AllTypes."));
    assert_eq!(libraries.count(), loader::platform_folders().len());
}

#[test]
fn every_shipped_fmu_shows_a_picture() {
    let Some(dist) = std::env::var_os("HELIOTORQUE_DIST") else {
        eprintln!("skipped: HELIOTORQUE_DIST is not set: run `cargo xtask test`");
        return;
    };
    for name in ["MomentumPlant", "SpinPlant", "DisturbanceTorque"] {
        let all = entries(&Path::new(&dist).join(format!("{name}.fmu")));
        let picture = all.iter().find(|(entry, _)| entry == "model.png");
        assert!(picture.is_some_and(|(_, bytes)| bytes.starts_with(b"\x89PNG")), "{name} has no picture");
    }
}

#[test]
fn the_documentation_names_every_variable() {
    let Some((_room, path)) = packed("AllTypes") else { return };
    let all = entries(&path);
    let find = |name: &str| {
        let bytes = &all.iter().find(|(entry, _)| entry == name).unwrap().1;
        String::from_utf8(bytes.clone()).unwrap()
    };
    let page = find("documentation/index.html");
    let description = model_description::parse(find("modelDescription.xml").as_bytes()).unwrap().description;
    for variable in &description.variables {
        let cell = format!("<td class=\"n\">{}</td>", model_description::escape(&variable.name));
        assert!(page.contains(&cell), "{} is missing", variable.name);
    }
    for symbol in loader::SYMBOLS {
        assert!(page.contains(symbol), "{symbol} is missing");
    }
    assert!(page.contains("Gr\u{fc}\u{df}e") && page.contains("&lt;&amp;"), "texts are escaped");
    let (opened, closed) = (page.matches("<t").count(), page.matches("</t").count());
    // Everything that begins with <t is a table, row, cell or title, and each is closed.
    assert_eq!(opened, closed);
}

#[test]
fn a_template_gives_a_new_fmu_under_its_own_name() {
    let Some((room, template)) = packed("AllTypes") else { return };
    let mine = room.path().join("Mine.fmu");
    run(&["pack", "--template", shown(&template), "--name", "Mine", "--output", shown(&mine)], 0);
    let names: Vec<String> = entries(&mine).into_iter().map(|(name, _)| name).collect();
    assert!(names.iter().any(|name| name.ends_with(&format!("/Mine{}", std::env::consts::DLL_SUFFIX))));
    assert!(names.iter().any(|name| name == "licenses/LICENSE-MIT.txt"));
    assert!(run(&["info", shown(&mine)], 0).contains("Mine"));
    run(&["run", shown(&mine), "--quiet"], 0);

    // A renamed template still knows its model.
    let next = room.path().join("Next.fmu");
    run(&["pack", "--template", shown(&mine), "--name", "Next", "--output", shown(&next)], 0);
    run(&["run", shown(&next), "--quiet"], 0);
}

#[test]
fn what_cannot_be_packed_says_why() {
    let Some(library) = probe_library() else { return };
    let room = tempfile::tempdir().unwrap();
    let output = room.path().join("x.fmu");
    let pack = |more: &[&str]| {
        let mut arguments = vec!["pack", "--library", shown(&library), "--output", shown(&output)];
        arguments.extend(more);
        run(&arguments, 1)
    };
    let text = pack(&["--model", "Warp"]);
    assert!(text.contains("Warp") && text.contains("AllTypes"), "{text}");
    assert!(pack(&["--model", "AllTypes", "--name", "my craft"]).contains("no C identifier"));
    assert!(pack(&["--model", "AllTypes", "--spacecraft", "no/such.toml"]).contains("no/such.toml"));
    let toml = room.path().join("odd.toml");
    fs::write(&toml, "unknown_key = 1\n").unwrap();
    let text = pack(&["--model", "AllTypes", "--spacecraft", shown(&toml)]);
    assert!(text.contains("odd.toml"), "{text}");
    fs::write(&toml, b"a = 1\nb = \"\xff\"\n").unwrap();
    assert!(pack(&["--model", "AllTypes", "--spacecraft", shown(&toml)]).contains("line 2 is not UTF-8"));
    assert!(!output.exists(), "a failed pack leaves a file");

    let text =
        run(&["pack", "--library", "no-such-library.so", "--model", "M", "--output", shown(&output)], 1);
    assert!(text.contains("does not load"), "{text}");
}

#[test]
fn outputs_of_single_plates_are_added_on_request() {
    let Some(library) = library() else { return };
    let room = tempfile::tempdir().unwrap();
    let shipped = "../../fmu-src/resources/messenger-thermal.toml";
    let toml = room.path().join("mine.toml");
    let body = fs::read_to_string(shipped).unwrap();
    fs::write(&toml, format!("per_plate_outputs = false # for now\n{body}")).unwrap();
    let pack = |spacecraft: &str, per_plate: bool, name: &str| {
        let fmu = room.path().join(format!("{name}.fmu"));
        let mut arguments = vec!["pack", "--library", shown(&library), "--model", "DisturbanceTorque"];
        arguments.extend(["--spacecraft", spacecraft, "--output", shown(&fmu)]);
        arguments.extend(per_plate.then_some("--per-plate"));
        run(&arguments, 0);
        let all = entries(&fmu);
        let find = |name: &str| {
            let bytes = &all.iter().find(|(entry, _)| entry == name).unwrap().1;
            String::from_utf8(bytes.clone()).unwrap()
        };
        (find("modelDescription.xml"), find("resources/spacecraft.toml"), fmu)
    };

    let (plain, _, _) = pack(shipped, false, "Plain");
    assert!(!plain.contains("plate[1]"));
    let (added, file, fmu) = pack(shipped, true, "Added");
    assert_eq!(file, format!("per_plate_outputs = true\n{body}"));
    for variable in ["plate[1].temperature", "plate[1].force[3]"] {
        assert!(added.contains(&format!("\"{variable}\"")), "{variable} is missing");
    }
    // Bound to the file as packed: the GUID is that of the same file given by hand.
    let by_hand = room.path().join("by-hand.toml");
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
    let room = tempfile::tempdir().unwrap();
    let output = room.path().join("Ace.fmu");
    let arguments = ["pack", "--library", shown(&library), "--output", shown(&output), "--spacecraft", ACE];
    let text = run(&[&arguments[..], &["--model", "MomentumPlant"]].concat(), 1);
    assert!(text.contains("this is a file of SpinPlant: see --model") && !output.exists(), "{text}");
    run(&[&arguments[..], &["--model", "SpinPlant"]].concat(), 0);
}

#[test]
fn models_without_outputs_of_single_plates_refuse_them() {
    let Some(library) = library() else { return };
    let room = tempfile::tempdir().unwrap();
    let output = room.path().join("x.fmu");
    let arguments = ["pack", "--library", shown(&library), "--output", shown(&output), "--per-plate"];
    for more in [["--model", "SpinPlant"].as_slice(), &["--model", "SpinPlant", "--spacecraft", ACE]] {
        let text = run(&[&arguments, more].concat(), 1);
        assert!(text.contains("--per-plate: SpinPlant has no outputs of single plates, allowed: "), "{text}");
        assert!(text.contains("DisturbanceTorque"), "{text}");
    }
    // A model without a file would take any text.
    if let Some(probe) = probe_library() {
        let text = run(
            &[
                "pack",
                "--library",
                shown(&probe),
                "--model",
                "Empty",
                "--output",
                shown(&output),
                "--per-plate",
            ],
            1,
        );
        assert!(
            text.contains("Empty has no outputs of single plates, allowed: none of this library"),
            "{text}"
        );
    }
    // What is wrong with the file itself is told by the lines of the file itself.
    let toml = room.path().join("odd.toml");
    fs::write(&toml, "name = \"A\"\nwings = 2\n").unwrap();
    let text =
        run(&[&arguments[..], &["--model", "DisturbanceTorque", "--spacecraft", shown(&toml)]].concat(), 1);
    assert!(text.contains("odd.toml:2: wings"), "{text}");
    assert!(!output.exists());
}
