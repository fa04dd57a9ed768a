//! Writes the corpus anew from the shipped files: `cargo run --manifest-path tests/fuzz/Cargo.toml --example seeds`.

use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;

use fmi_export::model_description::Status;
use heliotorque_fuzz::{HEADER, MODELS, Subject};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

fn main() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = package.join("../..");
    let shipped = |path: &str| fs::read(root.join(path)).unwrap();
    let seed = |target: &str, name: &str, bytes: &[u8]| {
        let folder = package.join("corpus").join(target);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join(name), bytes).unwrap();
    };
    for name in [
        "ace",
        "messenger",
        "messenger-full",
        "messenger-thermal",
        "examples/mercury-orbiter",
        "examples/solar-sailer",
    ] {
        let file = shipped(&format!("fmu-src/resources/{name}.toml"));
        seed("spacecraft", name.rsplit('/').next().unwrap(), &file);
    }
    let small = heliotorque_fuzz::library("AllTypes").find("AllTypes").unwrap().describe(None, None).unwrap();
    let small = model_description::to_xml(&small);
    seed("model_description", "AllTypes", small.as_bytes());
    seed("model_description", "DisturbanceTorque", &shipped("modelDescription/golden/DisturbanceTorque.xml"));
    seed("model_description", "Guidance", &shipped("modelDescription/golden/Guidance.xml"));
    seed("model_description", "unguarded", &shipped("tests/c/unguarded.xml"));
    for (choice, model) in (0_u8..).zip(MODELS) {
        for (name, payload) in states(choice) {
            seed("state", &format!("{model}-{name}"), &[&[choice], payload.as_slice()].concat());
        }
        // Set up, initialize, step, save, set a Real, step, serialize, restore, step, read, end.
        let simulation = [0, 2, 3, 4, 10, 17, 8, 3, 0, 0, 9, 5, 12, 19, 18, 6, 8, 21, 16, 3, 0, 5, 0, 22, 23];
        seed("calls", model, &[&[choice], simulation.as_slice()].concat());
    }
    for (name, method) in [("stored", CompressionMethod::Stored), ("deflated", CompressionMethod::Deflated)] {
        seed("zip", name, &archive(method, small.as_bytes()));
    }
}

/// Payloads of the states a master saves most.
fn states(choice: u8) -> Vec<(&'static str, Vec<u8>)> {
    Subject::with(choice, |subject| {
        let instance = &mut subject.instance;
        let fresh = instance.state_bytes().1;
        assert_eq!(instance.start(0.0, None), Status::Ok);
        for step in 0..5 {
            assert_eq!(instance.do_step(60.0 * f64::from(step), 60.0), Status::Ok);
        }
        let running = instance.state_bytes().1;
        let payloads = vec![("fresh", fresh[HEADER..].to_vec()), ("running", running[HEADER..].to_vec())];
        for (name, payload) in &payloads {
            // A seed behind a header that is refused would never reach the decoder.
            let sealed = subject.seal(payload);
            assert_eq!(subject.instance.deserialize(&sealed).0, Status::Ok, "{name}");
        }
        payloads
    })
}

/// An FMU in small.
fn archive(method: CompressionMethod, xml: &[u8]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method);
    zip.add_directory("resources", options).unwrap();
    for (name, content) in [("modelDescription.xml", &xml[..600]), ("resources/a.toml", b"name = \"a\"")] {
        zip.start_file(name, options).unwrap();
        zip.write_all(content).unwrap();
    }
    zip.finish().unwrap().into_inner()
}
