//! FMUs that are not ours with annotations added by hand: wired, simulated and judged by these.

use std::{collections::BTreeMap, fs, io::Read, path::Path};

use files::Entries;

use crate::{packed, run, says, shown};

/// Writes an FMU whose variables of these names have annotations of ours.
fn annotate(from: &Path, to: &Path, annotations: &[(&str, &str)]) {
    let mut archive = zip::ZipArchive::new(fs::File::open(from).unwrap()).unwrap();
    let mut contents = BTreeMap::new();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).unwrap();
        let mut content = Vec::new();
        entry.read_to_end(&mut content).unwrap();
        contents.insert(entry.name().unwrap().into_owned(), content);
    }
    let mut xml = String::from_utf8(contents.remove("modelDescription.xml").unwrap()).unwrap();
    for (name, annotation) in annotations {
        let variable = xml.find(&format!("<ScalarVariable name=\"{name}\"")).unwrap();
        let end = variable + xml[variable..].find("</ScalarVariable>").unwrap();
        let tool = format!("<Tool name=\"io.github.heliotorque\">{annotation}</Tool>");
        xml.insert_str(
            end,
            &format!("<Annotations><Tool name=\"other\"><Variable role=\"?\"/></Tool>{tool}</Annotations>"),
        );
    }
    let mut entries = Entries::default();
    entries.add("modelDescription.xml", xml.into_bytes()).unwrap();
    contents.into_iter().for_each(|(path, content)| entries.add(&path, content).unwrap());
    fs::write(to, entries.to_zip().unwrap()).unwrap();
}

#[test]
fn two_fmus_are_wired_by_annotations_added_by_hand() {
    let Some((scratch, probe)) = packed("AllTypes") else { return };
    let file = |name: &str| scratch.path().join(name);
    let (source, sink, system, table) =
        (file("source.fmu"), file("sink.fmu"), file("pair.ssp"), file("pair.csv"));
    annotate(&probe, &source, &[("output.real", "<Variable role=\"era\"/>")]);
    let input = "<Variable alsoCalled=\"output.real\"><ReadWhere option=\"parameter.choice\" items=\"red 2\" set=\"red\"/></Variable>";
    annotate(&probe, &sink, &[("input.real", input)]);
    let report = run(&["wire", shown(&source), shown(&sink), "--output", shown(&system)], 0);
    says(
        &report,
        &[
            "1 connections\n  source to sink:\n    output.real to input.real\n",
            "sink.parameter.choice=red",
            "source.fmu: modelDescription.xml, line ",
            "annotation of `output.real`: attribute `role` is `era`; allowed is one of epoch, litFraction, nextEvent",
        ],
    );
    let simulate = ["run", shown(&system), "--stop", "2", "--set", "source.input.real=3"];
    let record = ["--record", "sink.output.real,sink.parameter.choice", "--output", shown(&table)];
    run(&[&simulate[..], &record].concat(), 0);
    let last = fs::read_to_string(&table).unwrap().lines().last().unwrap().to_owned();
    assert!(last.starts_with("2,3,"), "{last}");
    let unread = run(&[&simulate[..], &record, &["--set", "sink.parameter.choice=blue"]].concat(), 0);
    says(
        &unread,
        &["connected and not read: input.real: found parameter.choice at blue, allowed: red, green"],
    );
    says(&run(&["check", shown(&source), "--static"], 0), &["annotation of `output.real`"]);
}
