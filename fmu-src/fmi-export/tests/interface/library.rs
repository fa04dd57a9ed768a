//! The GUID finds the model; when it does not, the log names every GUID that was compared.

use client::InProcess;
use fmi_export::model_description::{Description, Status};

use super::{PROBE, described};

fn guid(model: &str, setup: &str) -> String {
    PROBE.find(model).unwrap().describe(None, Some(setup)).unwrap().guid
}

/// A folder that goes away with the value.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new<T: AsRef<[u8]>>(name: &str, files: &[(&str, T)]) -> Self {
        let folder = std::env::temp_dir().join(format!("fmi-export-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for (file, text) in files {
            std::fs::write(folder.join(file), text).unwrap();
        }
        Self(folder)
    }

    fn uri(&self) -> String {
        format!("file://{}", self.0.to_str().unwrap())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

const TWO: &str = "label = 'two'\n[[channel]]\ngain = 2.0\n";

#[test]
fn a_guid_depends_on_content_and_not_on_form() {
    assert_eq!(guid("AllTypes", TWO), guid("AllTypes", "channel = [{ gain = 2 }] # same\nlabel = 'two'"));
    assert_ne!(guid("AllTypes", TWO), guid("AllTypes", "label = 'two'"));
    assert_ne!(guid("AllTypes", TWO), guid("AllTypes", "label = 'two'\n[[channel]]\ngain = 2.5\n"));
    let guids = ["Empty", "AllTypes", "Panicking"].map(|model| described(model).guid);
    for (i, guid) in guids.iter().enumerate() {
        assert!(guid.len() == 38 && guid.starts_with('{') && guid.ends_with('}'), "{guid}");
        assert!(guids[..i].iter().all(|other| other != guid));
    }
}

#[test]
fn the_guid_and_the_setup_file_find_the_model() {
    let folder = Folder::new("found", &[("all-types.toml", TWO)]);
    let instance = InProcess::instantiate(PROBE, &guid("AllTypes", TWO), Some(&folder.uri()));
    assert!(instance.unwrap().drain_messages().is_empty());
    // Models without a setup file, or whose file is not there, do not stand in the way.
    InProcess::instantiate(PROBE, &described("Empty").guid, Some(&folder.uri())).unwrap();
    InProcess::instantiate(PROBE, &described("Empty").guid, Some("file:///no/such/folder")).unwrap();
    for location in [None, Some("")] {
        InProcess::instantiate(PROBE, &described("AllTypes").guid, location).unwrap();
    }
}

fn refused(guid: &str, location: Option<&str>) -> String {
    let mut messages = InProcess::instantiate(PROBE, guid, location).unwrap_err();
    assert_eq!(messages.len(), 1, "{messages:?}");
    messages.remove(0).text
}

#[test]
fn an_unknown_guid_lists_what_is_known() {
    let text = refused("{nonsense}", None);
    assert!(
        text.contains("{nonsense}") && text.contains("is NULL or empty, and there is no folder"),
        "{text}"
    );
    for model in ["Empty", "AllTypes", "Panicking"] {
        assert!(text.contains(&format!("{model} has GUID {}", described(model).guid)), "{text}");
    }
}

#[test]
fn a_setup_file_changed_after_packing_is_named() {
    let folder = Folder::new("changed", &[("all-types.toml", TWO)]);
    let text = refused(&described("AllTypes").guid, Some(&folder.uri()));
    assert!(
        text.starts_with("fmi2Instantiate: all-types.toml: the file was changed after packing"),
        "{text}"
    );
    assert!(text.contains(&guid("AllTypes", TWO)), "{text}");
    // Nobody else matters then, and what is wrong with the file does.
    assert!(!text.contains("Empty") && !text.contains("Panicking"), "{text}");
    let folder = Folder::new("changed-and-damaged", &[("all-types.toml", "label = 'x\n")]);
    let text = refused(&described("AllTypes").guid, Some(&folder.uri()));
    assert!(
        text.starts_with("fmi2Instantiate: all-types.toml: the file was changed after packing"),
        "{text}"
    );
    assert!(text.contains("AllTypes cannot be set up: "), "{text}");
}

#[test]
fn a_bad_setup_file_or_folder_is_named() {
    let requested = guid("AllTypes", TWO);
    for (name, files, words) in [
        ("damaged", vec![("all-types.toml", "label = 'x\n")], ["all-types.toml", "cannot be set up"]),
        ("key", vec![("all-types.toml", "label = ''\nlabl = ''\n")], ["labl", "all-types.toml"]),
        ("none", vec![], ["all-types.toml", "cannot read"]),
    ] {
        let folder = Folder::new(name, &files);
        let text = refused(&requested, Some(&folder.uri()));
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
    }
    let text = refused(&requested, Some("file:///no/such%20folder"));
    // What could not be read is reported first, and once.
    assert!(
        text.starts_with("fmi2Instantiate: the resource location")
            && text.matches("such folder").count() == 1,
        "{text}"
    );
    assert!(text.contains("`/no/such folder`, which does not exist"), "{text}");
    let text = refused(&requested, Some("https://example.org/x"));
    assert!(text.contains("is no file URI"), "{text}");
}

#[test]
fn a_setup_file_that_is_not_there_is_the_first_thing_reported() {
    let folder = Folder::new::<&str>("empty", &[]);
    let text = refused(&guid("AllTypes", TWO), Some(&folder.uri()));
    assert!(text.starts_with("fmi2Instantiate: cannot read `") && text.contains("all-types.toml"), "{text}");
    assert!(text.contains(&described("Empty").guid) && !text.contains("belong together"), "{text}");
}

#[test]
fn a_model_that_panics_while_described_hides_nobody() {
    for place in ["parseSetup", "about", "declare", "serializeSetup"] {
        let setup = format!("panic_in = '{place}'");
        let folder = Folder::new(place, &[("panicking.toml", setup.as_str()), ("all-types.toml", TWO)]);
        let text = refused("{x}", Some(&folder.uri()));
        assert!(text.contains("Panicking cannot be set up: the model panicked"), "{text}");
        InProcess::instantiate(PROBE, &guid("AllTypes", TWO), Some(&folder.uri())).unwrap();
    }
}

#[test]
fn the_description_declares_what_the_library_can() {
    let Description { co_simulation, structure, units, types, .. } = described("AllTypes");
    let co_simulation = co_simulation.unwrap();
    assert_eq!(co_simulation.model_identifier, "AllTypes");
    assert_eq!(co_simulation.max_output_derivative_order, 1);
    let flags = [
        co_simulation.can_handle_variable_communication_step_size,
        co_simulation.can_interpolate_inputs,
        co_simulation.can_not_use_memory_management_functions,
        co_simulation.can_get_and_set_fmu_state,
        co_simulation.can_serialize_fmu_state,
        co_simulation.provides_directional_derivative,
        !co_simulation.can_run_asynchronuously,
        !co_simulation.can_be_instantiated_only_once_per_process,
        !co_simulation.needs_execution_tool,
    ];
    assert_eq!(flags, [true; 9]);
    assert!(!structure.outputs.is_empty() && structure.derivatives.is_empty());
    assert!(units.iter().any(|unit| unit.name == "m/s") && units.iter().all(|unit| unit.name != "Pa"));
    assert_eq!(types.len(), 1);
}

const SCHEDULE: &str = "all-types-schedule.toml";

/// The status of a step from 0 to 3 s.
fn step_of_3_s(instance: &mut InProcess) -> Status {
    assert_eq!(instance.start(0.0, None), Status::Ok);
    instance.do_step(0.0, 3.0)
}

#[test]
fn a_schedule_is_taken_where_there_is_one_and_leaves_the_guid() {
    let without = Folder::new("no-schedule", &[("all-types.toml", TWO)]);
    let with = Folder::new("schedule", &[("all-types.toml", TWO), (SCHEDULE, "end_s = 2.0\n")]);
    let requested = guid("AllTypes", TWO);
    let mut instance = InProcess::instantiate(PROBE, &requested, Some(&without.uri())).unwrap();
    assert_eq!(step_of_3_s(&mut instance), Status::Ok);
    let mut instance = InProcess::instantiate(PROBE, &requested, Some(&with.uri())).unwrap();
    assert_eq!(step_of_3_s(&mut instance), Status::Discard);
    // It outlives a reset, as the setup does.
    assert_eq!(instance.reset(), Status::Ok);
    assert_eq!(step_of_3_s(&mut instance), Status::Discard);
    // The compiled-in setup has none, and a model that takes none leaves it alone.
    let mut instance = InProcess::instantiate(PROBE, &described("AllTypes").guid, None).unwrap();
    assert_eq!(step_of_3_s(&mut instance), Status::Ok);
    let torn = Folder::new("torn-for-others", &[(SCHEDULE, "end_s = ")]);
    InProcess::instantiate(PROBE, &described("Empty").guid, Some(&torn.uri())).unwrap();
}

#[test]
fn a_bad_schedule_is_named_with_its_line() {
    let requested = guid("AllTypes", TWO);
    let files = |schedule: &'static [u8]| [("all-types.toml", TWO.as_bytes()), (SCHEDULE, schedule)];
    for (name, schedule, words) in [
        ("torn", b"# two\nend_s = ".as_slice(), ["all-types-schedule.toml: ", "line 2"]),
        ("unknown", b"\nend_s = 1\nstart_s = 2\n", ["all-types-schedule.toml: ", "start_s"]),
        ("latin", b"end_s = 1\n# gr\xfc\xdfe\n", ["all-types-schedule.toml`: ", "line 2 is not UTF-8"]),
    ] {
        let folder = Folder::new(&format!("schedule-{name}"), &files(schedule));
        let text = refused(&requested, Some(&folder.uri()));
        assert!(words.iter().all(|word| text.contains(word)), "{name}: {text}");
        assert!(!text.contains("GUID"), "{text}");
    }
    let folder = Folder::new("schedule-folder", &[("all-types.toml", TWO)]);
    std::fs::create_dir(folder.0.join(SCHEDULE)).unwrap();
    let text = refused(&requested, Some(&folder.uri()));
    assert!(text.contains("no regular file"), "{text}");
}
