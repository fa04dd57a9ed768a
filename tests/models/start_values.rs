//! Start values in a setup file: what they become, for which models, and the error for those that nothing takes.

use std::path::Path;

use super::named_model::LIBRARY;
use client::InProcess;
use fmi_export::{Model, Status};
use model_description::{Description, VariableKind};
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};

/// The shipped file of a model with lines added at its end.
fn text<M: Model>(lines: &str) -> String {
    let shipped = M::DEFAULT_SETUP.split("\n[start]").next().unwrap();
    format!("{shipped}\n{lines}")
}

fn described<M: Model>(lines: &str) -> Result<Description, String> {
    let entry = LIBRARY.find(M::NAME).unwrap();
    LIBRARY.describe(entry, Some("my.toml"), Some(&text::<M>(lines))).map_err(|error| error.to_string())
}

/// The start value as the XML has it.
fn start(description: &Description, name: &str) -> String {
    let variable = description.variables.iter().find(|variable| variable.name == name).unwrap();
    match &variable.kind {
        VariableKind::Real { start, .. } => format!("{:?}", start.unwrap()),
        VariableKind::Integer { start, .. } | VariableKind::Enumeration { start, .. } => {
            start.unwrap().to_string()
        }
        VariableKind::Boolean { start, .. } => start.unwrap().to_string(),
        VariableKind::String { start, .. } => start.clone().unwrap(),
    }
}

#[test]
fn an_epoch_takes_a_date() {
    // 24 Julian years and six leap days' difference are 9496.5 days past J2000, 37 + 32.184 s behind TT.
    let past_j2000 = |lines: &str| -> f64 {
        start(&described::<MomentumPlant>(lines).unwrap(), "start.epoch").parse().unwrap()
    };
    let utc_s = past_j2000("[start]\n\"start.epoch\" = \"2026-01-01T00:00:00 UTC\"");
    assert!((utc_s - (9496.5 * 86_400.0 + 69.184)).abs() < 2e-3, "{utc_s}");
    let for_this_model = "[start.MomentumPlant]\n\"start.epoch\" = \"2009-04-06 TDB\"";
    assert_eq!(past_j2000(for_this_model), 292_248_000.0);
    // A number, with its unit too, stays what it was.
    assert_eq!(past_j2000("[start]\n\"start.epoch\" = \"2000 d\""), 172_800_000.0);
}

#[test]
fn times_take_dates_that_count_from_the_epoch_beside_them() {
    let guidance = |lines: &str| described::<Guidance>(lines);
    let seconds =
        |description: &Description, name: &str| -> f64 { start(description, name).parse().unwrap() };
    // A leap second ends 2016.
    let lines = "[start]\n\"start.epoch\" = \"2016-12-31T23:00:00 UTC\"\n\"burn.start\" = \"2017-01-01T01:00:00 UTC\"\n\
                 \"guided.downlinkReference\" = \"start\"\n\"guided.downlinkStart\" = \"2017-01-01T00:00:00 UTC\"\n\
                 \"guided.downlinkEnd\" = \"9 h\"";
    let found = guidance(lines).unwrap();
    assert_eq!(seconds(&found, "burn.start"), 7201.0);
    assert_eq!(seconds(&found, "guided.downlinkStart"), 3601.0);
    assert_eq!(seconds(&found, "guided.downlinkEnd"), 32_400.0);
    // The model's own epoch is 2009-04-06 TDB.
    let found = guidance("[start]\n\"burn.start\" = \"2009-04-07 TDB\"").unwrap();
    assert_eq!(seconds(&found, "burn.start"), 86_400.0);
    // From periapsis no date counts.
    let refused =
        described::<MomentumPlant>("[start]\n\"guided.downlinkStart\" = \"2009-04-07 TDB\"").unwrap_err();
    for part in [
        "my.toml:",
        "guided.downlinkStart",
        "2009-04-07 TDB",
        "periapsis",
        "\"guided.downlinkReference\" = \"start\"",
    ] {
        assert!(refused.contains(part), "{part} is missing in: {refused}");
    }
    let refused = guidance("[start]\n\"burn.start\" = \"2009-04-07\"").unwrap_err();
    assert!(refused.contains("burn.start") && refused.contains("UTC, Z, TDB"), "{refused}");
    // A model without an epoch counts from none.
    assert!(described::<SpinPlant>("[start]\n\"burn.start\" = \"2009-04-07 TDB\"").is_err());
}

#[test]
fn one_value_is_that_of_every_element() {
    let described = described::<MomentumPlant>("[start]\n\"dump.threshold\" = \"3 N.m.s\"").unwrap();
    for k in 1..=3 {
        assert_eq!(start(&described, &format!("dump.threshold[{k}]")), "3.0");
    }
}

#[test]
fn every_base_type_and_unit_becomes_a_start_value() {
    let lines = r#"
[start]
"spacecraft.mass" = 650
"guided.scienceGain" = "30 %"
"guided.downlinkStart" = "2 h"
"orbit.inclination" = "60deg"
"planetLight.nodes" = 7
"planetLight.enabled" = true
"orbit.center" = "sun"
"dump.threshold" = [1, 2.5, "4 N.m.s"]
"spacecraft.inertia" = [[100, 1, 2], [1, 200, 3], [2, 3, 150]]
"torque.applied[2]" = "2 uN.m"
"#;
    let description = described::<MomentumPlant>(lines).unwrap();
    for (name, expected) in [
        ("spacecraft.mass", "650.0"),
        ("guided.scienceGain", "0.3"),
        ("guided.downlinkStart", "7200.0"),
        // The last bit as in 60 / (180 / pi).
        ("orbit.inclination", "1.0471975511965976"),
        ("planetLight.nodes", "7"),
        ("planetLight.enabled", "true"),
        ("orbit.center", "2"),
        ("dump.threshold[1]", "1.0"),
        ("dump.threshold[2]", "2.5"),
        ("dump.threshold[3]", "4.0"),
        ("spacecraft.inertia[1,3]", "2.0"),
        ("spacecraft.inertia[2,2]", "200.0"),
        ("torque.applied[1]", "0.0"),
        ("torque.applied[2]", "2e-6"),
    ] {
        assert_eq!(start(&description, name), expected, "{name}");
    }
    let spinner = described::<SpinPlant>("start = 0").unwrap_err();
    assert!(spinner.contains("start"), "{spinner}");
    let spinner = described::<SpinPlant>("[start]\n\"burn.group\" = \"spin up\"\nseed = 5").unwrap();
    assert_eq!((start(&spinner, "burn.group"), start(&spinner, "seed")), ("spin up".into(), "5".into()));
}

#[test]
fn an_instance_begins_with_them_and_returns_to_them() {
    let lines =
        "[start]\n\"spacecraft.centerOfMass\" = [0.01, 0, \"-2 cm\"]\n\"sunshade.shape\" = \"cylinder\"\n";
    let text = format!("{}{}", DisturbanceTorque::DEFAULT_SETUP, lines.strip_prefix("[start]\n").unwrap());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("start-values");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("spacecraft.toml"), &text).unwrap();
    let entry = LIBRARY.find("DisturbanceTorque").unwrap();
    let description = LIBRARY.describe(entry, None, Some(&text)).unwrap();
    let plain = LIBRARY.describe(entry, None, None).unwrap();
    assert_ne!(description.guid, plain.guid);

    let real = |name: &str| description.variables.iter().find(|it| it.name == name).unwrap().value_reference;
    let shape = real("sunshade.shape");
    let center = [1, 2, 3].map(|i| real(&format!("spacecraft.centerOfMass[{i}]")));
    let torque = [1, 2, 3].map(|i| real(&format!("torque.total[{i}]")));
    let location = format!("file://{}", folder.display());
    let mut fmu = InProcess::instantiate(&LIBRARY, &description.guid, Some(&location)).unwrap();
    let read = |fmu: &mut InProcess| {
        assert_eq!(fmu.start(0.0, None), Status::Ok);
        let mut values = [0.0; 3];
        assert_eq!(fmu.get_real(&torque, &mut values), Status::Ok);
        values.map(f64::to_bits)
    };
    let from_file = read(&mut fmu);
    assert_eq!(fmu.reset(), Status::Ok);
    assert_eq!(read(&mut fmu), from_file);

    // The shipped FMU, set alike by its master.
    let mut reported = InProcess::instantiate(&LIBRARY, &plain.guid, None).unwrap();
    assert_ne!(read(&mut reported), from_file);
    assert_eq!(reported.reset(), Status::Ok);
    assert_eq!(reported.set_real(&center, &[0.01, 0.0, -0.02]), Status::Ok);
    assert_eq!(reported.set_integer(&[shape], &[2]), Status::Ok);
    assert_eq!(read(&mut reported), from_file);
}

#[test]
fn the_more_particular_wins() {
    let lines = r#"
[start.MomentumPlant]
"dump.threshold" = [7, 7, 7]
[start]
"dump.threshold[3]" = 3
"dump.threshold" = [1, 1, 1]
"start.momentum[2]" = 0.5
"start.momentum" = [0.1, 0.1, 0.1]
"solar.flux" = 1400
[start.DisturbanceTorque]
"solar.flux" = 1300
"#;
    let plant = described::<MomentumPlant>(lines).unwrap();
    assert_eq!(start(&plant, "dump.threshold[3]"), "7.0");
    assert_eq!(start(&plant, "start.momentum[1]"), "0.1");
    assert_eq!(start(&plant, "start.momentum[2]"), "0.5");
    assert_eq!(start(&plant, "solar.flux"), "1400.0");
    // It knows no dump.threshold: another model of its library does.
    assert_eq!(start(&described::<DisturbanceTorque>(lines).unwrap(), "solar.flux"), "1300.0");
}

#[test]
fn the_guid_follows_the_values_and_not_how_they_are_written() {
    let guid = |lines: &str| described::<MomentumPlant>(lines).unwrap().guid;
    let plain = guid("");
    assert_eq!(guid("[start]\n\"spacecraft.mass\" = 700"), plain);
    let mass = guid("[start]\n\"spacecraft.mass\" = 701");
    assert_ne!(mass, plain);
    assert_eq!(guid("# mine\n[start.MomentumPlant]\n'spacecraft.mass' = \"701 kg\""), mass);
    assert_eq!(guid("[start]\n\"planetLight.belts\" = 9"), plain, "of another model");
}

/// File lines, and the error for each; the shipped file's own lines are left out of the number.
const REFUSALS: &[(&str, &str)] = &[
    (
        "[start]\n\"orbit.centre\" = \"sun\"",
        "my.toml:+2: start.\"orbit.centre\": found the unknown name \"orbit.centre\" (did you mean \"orbit.center\"?), \
         allowed: a parameter or an input of MomentumPlant or DisturbanceTorque or Guidance",
    ),
    (
        "[start]\n\"burn.count\" = 3",
        "my.toml:+2: start.\"burn.count\": found the unknown name \"burn.count\" (did you mean \"burn.gain\"?), allowed: a parameter or an input of MomentumPlant or DisturbanceTorque or Guidance",
    ),
    (
        "[start]\n\"planetLight.belt\" = 3",
        "my.toml:+2: start.\"planetLight.belt\": found the unknown name \"planetLight.belt\" (did you mean \
         \"planetLight.belts\"?), allowed: a parameter or an input of MomentumPlant or DisturbanceTorque or Guidance",
    ),
    (
        "[start.MomentumPlant]\n\"planetLight.belts\" = 3",
        "my.toml:+2: start.MomentumPlant.\"planetLight.belts\": found the unknown name \"planetLight.belts\" (did you \
         mean \"planetLight.nodes\"?), allowed: a parameter or an input of MomentumPlant",
    ),
    (
        "[start.DisturbanceTorque]\n\"dump.threshold\" = [1, 1, 1]",
        "my.toml:+2: start.DisturbanceTorque.\"dump.threshold\": found the unknown name \"dump.threshold\", allowed: a \
         parameter or an input of DisturbanceTorque",
    ),
    (
        "[start.MomentumPlnat]\n\"dump.threshold\" = [1, 1, 1]",
        "my.toml:+2: start.MomentumPlnat.\"dump.threshold\": found the unknown model \"MomentumPlnat\" (did you mean \
         \"MomentumPlant\"?), allowed: MomentumPlant, DisturbanceTorque, Guidance, which read this file; the name of a variable \
         stands in quotes as a whole",
    ),
    (
        "[start.SpinPlant]\nseed = 3",
        "my.toml:+2: start.SpinPlant.seed: found the unknown model \"SpinPlant\", allowed: MomentumPlant, \
         DisturbanceTorque, Guidance, which read this file; the name of a variable stands in quotes as a whole",
    ),
    (
        "[start]\norbit.center = \"sun\"",
        "my.toml:+2: start.orbit.center: found the unknown model \"orbit\", allowed: MomentumPlant, DisturbanceTorque, \
         Guidance, which read this file; the name of a variable stands in quotes as a whole",
    ),
    (
        "[start.MomentumPlant]\norbit.center = \"sun\"",
        "my.toml:+2: start.MomentumPlant.orbit: found a table, allowed: a number, a string, true or false, a list; the \
         name of a variable stands in quotes as a whole",
    ),
    (
        "[start]\n\"torque.total[1]\" = 1",
        "my.toml:+2: start.\"torque.total[1]\": found the output torque.total[1], allowed: a parameter or an input",
    ),
    (
        "[start]\n\"torque.total\" = [1, 2, 3]",
        "my.toml:+2: start.\"torque.total\": found the output torque.total, allowed: a parameter or an input",
    ),
    (
        "[start]\n\"orbit.center\" = \"pluto\"",
        "my.toml:+2: start.\"orbit.center\": found \"pluto\", allowed: mercury (1), sun (2), venus (3), earth (4), mars (6), jupiter (7), and custom where the file has a table [body]",
    ),
    (
        "[start]\n\"orbit.center\" = 9",
        "my.toml:+2: start.\"orbit.center\": found 9, allowed: mercury (1), sun (2), venus (3), earth (4), mars (6), jupiter (7)",
    ),
    (
        "[start]\n\"orbit.eccentricity\" = -0.5",
        "my.toml:+2: start.\"orbit.eccentricity\": found -0.5, allowed: a number from 0 to 1000",
    ),
    (
        "[start]\n\"orbit.eccentricity\" = nan",
        "my.toml:+2: start.\"orbit.eccentricity\": found NaN, allowed: a number from 0 to 1000",
    ),
    (
        "[start]\n\"orbit.step\" = \"2 d\"",
        "my.toml:+2: start.\"orbit.step\": found \"2 d\", allowed: a number from 1 to 86400 s",
    ),
    (
        "[start]\n\"orbit.step\" = \"1 week\"",
        "my.toml:+2: start.\"orbit.step\": found \"1 week\" with the unknown unit \"week\", allowed: a number, with one of \
         the units s, ms, min, h, d, a",
    ),
    (
        "[start]\n\"start.epoch\" = \"2026-02-29 UTC\"",
        "my.toml:+2: start.\"start.epoch\": found \"2026-02-29 UTC\", a day that no calendar has, allowed: a date such as \
         \"2008-03-19T19:30:00 UTC\" or \"JD 2454544.5 TDB\"",
    ),
    (
        "[start]\n\"start.epoch\" = \"2026-01-01T00:00:00\"",
        "my.toml:+2: start.\"start.epoch\": found \"2026-01-01T00:00:00\", which does not end in UTC, Z, TDB, TT or TAI, allowed: a date \
         such as \"2008-03-19T19:30:00 UTC\" or \"JD 2454544.5 TDB\"",
    ),
    (
        "[start]\n\"orbit.step\" = \"2026-01-01 UTC\"",
        "my.toml:+2: start.\"orbit.step\": found \"2026-01-01 UTC\" with the unknown unit \"-01-01 UTC\", allowed: a \
         number, with one of the units s, ms, min, h, d, a",
    ),
    (
        "[start]\n\"orbit.step\" = true",
        "my.toml:+2: start.\"orbit.step\": found true, allowed: a number, with one of the units s, ms, min, h, d, a",
    ),
    (
        "[start]\n\"orbit.step\" = 2011-04-06",
        "my.toml:+2: start.\"orbit.step\": found the time 2011-04-06, allowed: a number, a string (dates stand in quotes), true or false, a list",
    ),
    (
        "[start]\n\"planetLight.nodes\" = 6.0",
        "my.toml:+2: start.\"planetLight.nodes\": found 6.0, allowed: a whole number within 32 bits",
    ),
    (
        "[start]\n\"planetLight.nodes\" = 65",
        "my.toml:+2: start.\"planetLight.nodes\": found 65, allowed: a number from 1 to 64",
    ),
    (
        "[start]\n\"thermal.enabled\" = \"yes\"",
        "my.toml:+2: start.\"thermal.enabled\": found \"yes\", allowed: true or false",
    ),
    (
        "[start]\n\"start.momentum\" = [1, 2]",
        "my.toml:+2: start.\"start.momentum\": found a list of length 2, allowed: a list of length 3",
    ),
    (
        "[start]\n\"start.momentum\" = true",
        "my.toml:+2: start.\"start.momentum\": found true, allowed: a number, with one of the units N.m.s",
    ),
    (
        "[start]\n\"spacecraft.inertia\" = 5",
        "my.toml:+2: start.\"spacecraft.inertia\": found 5, allowed: 3 lists of length 3",
    ),
    (
        "[start]\n\"spacecraft.inertia\" = [1, 2, 3, 4, 5, 6, 7, 8, 9]",
        "my.toml:+2: start.\"spacecraft.inertia\": found a list of length 9, allowed: 3 lists of length 3",
    ),
    (
        "[start]\n\"spacecraft.mass\" = [1]",
        "my.toml:+2: start.\"spacecraft.mass\": found a list of length 1, allowed: a number, with one of the units kg",
    ),
    (
        "[start]\n\"dump.threshold\" = [1,\n -2, 3]\n\"orbit.center\" = \"pluto\"",
        "my.toml:+2: start.\"dump.threshold\": found -2, allowed: a number from 1e-6 to 1e100 N.m.s\n\
         my.toml:+4: start.\"orbit.center\": found \"pluto\", allowed: mercury (1), sun (2), venus (3), earth (4), mars (6), jupiter (7), and custom where the file has a table [body]",
    ),
];

#[test]
fn what_no_variable_takes_is_reported_by_line_and_key() {
    let before = text::<MomentumPlant>("").lines().count();
    let mut others = Vec::new();
    for (lines, expected) in REFUSALS {
        let reported = described::<MomentumPlant>(lines).unwrap_err();
        let relative: Vec<String> = reported
            .lines()
            .map(|line| {
                let (number, rest) = line.strip_prefix("my.toml:").unwrap().split_once(':').unwrap();
                format!("my.toml:+{}:{rest}", number.parse::<usize>().unwrap() - before)
            })
            .collect();
        if relative.join("\n") != *expected {
            others.push(format!("{lines}\ntold:     {}\nexpected: {expected}", relative.join("\n")));
        }
    }
    assert!(others.is_empty(), "{}", others.join("\n\n"));
}

#[test]
fn a_spinner_knows_no_other_models() {
    let reported = described::<SpinPlant>("[start]\n\"spin.initialRat\" = \"5 rpm\"").unwrap_err();
    assert!(
        reported
            .contains("(did you mean \"spin.initialRate\"?), allowed: a parameter or an input of SpinPlant"),
        "{reported}"
    );
    let rate = described::<SpinPlant>("[start]\n\"spin.initialRate\" = \"6 rpm\"").unwrap();
    assert_eq!(start(&rate, "spin.initialRate"), format!("{:?}", 6.0 / (30.0 / core::f64::consts::PI)));
}
