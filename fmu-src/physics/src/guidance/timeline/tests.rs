//! Every key of a command is read as written; a bad timeline is refused by line, key, what was found and what is allowed.

use core::f64::consts::PI;

use nalgebra::Vector3;
use proptest::prelude::*;

use super::*;
use crate::bodies::Body;
use crate::constants::DEG_RAD;
use crate::enumeration::Enumerated;
use crate::guidance::burn::velocity_path::VelocityPath;
use crate::guidance::geometry::lvlh::AzimuthReference;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::*;
use crate::spacecraft::{Antenna, AntennaRange, Instrument, MESSENGER_TOML, NamedAntenna, Spacecraft};

const MESSENGER_FULL: &str = include_str!("../../../../resources/messenger-full.toml");
const EXAMPLE: &str = include_str!("../../../../resources/examples/timeline.toml");

fn spacecraft() -> Spacecraft {
    let named = |name: &str| Instrument { name: name.to_owned(), boresight_body: Vector3::z(), gimbal: None };
    let rock = "[body]\nname = \"Rock\"\ngravitational_parameter_m3_s2 = 7e4\nradii_m = [5e3, 5e3, 5e3]";
    let text = format!("{MESSENGER_FULL}\n{rock}");
    let messenger = Spacecraft::from_toml("messenger-full.toml", &text).unwrap();
    let camera = messenger.instruments.last().unwrap().clone();
    Spacecraft { instruments: vec![named("MASCS"), named("MLA"), camera], ..messenger }
}

fn read(text: &str) -> Timeline {
    Timeline::from_toml("t.toml", text, &spacecraft()).unwrap_or_else(|error| panic!("{error}"))
}

/// One command at 0 s.
fn command(text: &str) -> TimelineEntry {
    read(&format!("[[command]]\nat = 0\n{text}")).entries[0]
}

#[test]
fn the_example_is_a_day_at_mercury() {
    let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
    let timeline = Timeline::from_toml("timeline.toml", EXAMPLE, &spacecraft).unwrap();
    assert_eq!(timeline.clock, TimelineClock::Epoch);
    let [first, .., last] = &timeline.entries[..] else { panic!("too few") };
    let start_s = crate::environment::dates::epoch_s("2011-04-06T00:00:00 UTC").unwrap();
    assert_eq!(first.at_s, start_s);
    assert!((last.until_s.unwrap() - first.at_s - 86_400.0).abs() < 1e-3);
    let scenarios: Vec<_> = timeline.entries.iter().filter_map(|entry| entry.command.scenario).collect();
    use Scenario::{Downlink, Generic, Gimbal, LimbTerminator, Nadir, PlusZ};
    assert_eq!(scenarios, [Nadir, LimbTerminator, Gimbal, Generic, Downlink, PlusZ, Nadir]);
    // Between the mosaic's end and the star nothing is commanded.
    let at = |hours: f64| timeline.slot(hours * 3600.0, start_s).entry;
    assert_eq!(at(4.3).and_then(|entry| entry.command.scan.frame), Some(ScanFrame::Body));
    assert_eq!(at(4.5), None);
    assert_eq!(at(10.0).and_then(|entry| entry.keep_in.elevation_rad), Some(10.0 * DEG_RAD));
}

#[test]
fn every_key_of_a_generic_command_is_read() {
    let of = |option| BoresightCommand { option: Some(option), ..BoresightCommand::default() };
    let (right_rad, back_rad, up_rad) = (-PI / 2.0, 135.0 * DEG_RAD, 40.0 * DEG_RAD);
    let turned = BoresightCommand {
        azimuth_rad: right_rad,
        elevation_rad: 0.25,
        ..of(BoresightOption::AzimuthElevation)
    };
    for (boresight, expected) in [
        (
            "option = \"vector\", vector = [1, 2.5, -3]",
            BoresightCommand { vector: Vector3::new(1.0, 2.5, -3.0), ..of(BoresightOption::Vector) },
        ),
        ("option = \"azEl\", azimuth = \"-90 deg\", elevation = 0.25", turned),
        (
            "option = \"gimbal\", angle = \"40 deg\"",
            BoresightCommand { angle_rad: up_rad, ..of(BoresightOption::Gimbal) },
        ),
        (
            "option = \"phasedArray\", azimuth = \"135 deg\"",
            BoresightCommand { azimuth_rad: back_rad, ..of(BoresightOption::PhasedArray) },
        ),
    ] {
        let text = format!(
            "scenario = \"generic\"\nboresight = {{ {boresight} }}\naimpoint = {{ option = \"sun\" }}\n\
             bodyRoll = {{ option = \"azEl\", azimuth = 1, elevation = \"-45 deg\" }}\n\
             externalRoll = {{ option = \"raDec\", rightAscension = \"180 deg\", declination = 0.5 }}"
        );
        let expected = PointingCommand {
            scenario: Some(Scenario::Generic),
            boresight: expected,
            aimpoint: AimpointCommand { option: Some(AimpointOption::Sun), ..AimpointCommand::default() },
            body_roll: BodyRollCommand {
                option: Some(BodyRollOption::AzimuthElevation),
                azimuth_rad: 1.0,
                elevation_rad: -PI / 4.0,
                ..BodyRollCommand::default()
            },
            external_roll: ExternalRollCommand {
                option: Some(ExternalRollOption::RightAscensionDeclination),
                right_ascension_rad: PI,
                declination_rad: 0.5,
                ..ExternalRollCommand::default()
            },
            ..PointingCommand::default()
        };
        assert_eq!(command(&text).command, expected, "{boresight}");
    }
    let text = "scenario = \"generic\"\nboresight = { option = \"vector\", vector = [0, 0, 1] }\n\
                aimpoint = { option = \"sun\" }\nbodyRoll = { option = \"vector\", vector = [0, -2, 0] }\n\
                externalRoll = { option = \"vector\", vector = [0, 0, 4] }";
    let found = command(text).command;
    assert_eq!(found.body_roll.vector, Vector3::new(0.0, -2.0, 0.0));
    assert_eq!(found.external_roll.vector, Vector3::new(0.0, 0.0, 4.0));
    for (name, option) in [
        ("sun", ExternalRollOption::Sun),
        ("earth", ExternalRollOption::Earth),
        ("planet", ExternalRollOption::Planet),
    ] {
        let text = text.replace("option = \"vector\", vector = [0, 0, 4]", &format!("option = \"{name}\""));
        assert_eq!(command(&text).command.external_roll.option, Some(option));
    }
}

#[test]
fn every_aimpoint_is_read_for_both_keys() {
    let none = AimpointCommand::default();
    let position = Vector3::new(1e3, 2.0, -ASTRONOMICAL_UNIT_M);
    use crate::constants::ASTRONOMICAL_UNIT_M;
    use AimpointOption as Option;
    let at = |option| AimpointCommand { option: Some(option), position_m: position, ..none };
    let local =
        |option| AimpointCommand { option: Some(option), azimuth_rad: 6.0, elevation_rad: -1.5, ..none };
    let alone = |option| AimpointCommand { option: Some(option), ..none };
    let (p, l) = (", position = [\"1 km\", 2, \"-1 AU\"]", ", azimuth = 6, elevation = -1.5");
    let body = |body| AimpointCommand { option: Some(Option::Body), body: Some(body), ..none };
    for (text, expected) in [
        (
            "vector\", vector = [0, 3, 0]".to_owned(),
            AimpointCommand { option: Some(Option::Vector), vector: Vector3::y() * 3.0, ..none },
        ),
        (
            "raDec\", rightAscension = 1, declination = -0.5".to_owned(),
            AimpointCommand {
                right_ascension_rad: 1.0,
                declination_rad: -0.5,
                ..alone(Option::RightAscensionDeclination)
            },
        ),
        (format!("earthCentered\"{p}"), at(Option::EarthCentered)),
        (format!("sunCentered\"{p}"), at(Option::SunCentered)),
        (format!("planetCentered\"{p}"), at(Option::PlanetCentered)),
        (format!("planetFixed\"{p}"), at(Option::PlanetFixed)),
        (
            "latLon\", latitude = \"-90 deg\", longitude = \"360 deg\", height = \"2 km\"".to_owned(),
            AimpointCommand {
                latitude_rad: -PI / 2.0,
                longitude_rad: 2.0 * PI,
                height_m: 2e3,
                ..alone(Option::LatitudeLongitude)
            },
        ),
        (format!("lvlhDowntrack\"{l}"), local(Option::LvlhDowntrack)),
        (format!("lvlhSun\"{l}"), local(Option::LvlhSun)),
        ("sun\"".to_owned(), alone(Option::Sun)),
        ("earth\"".to_owned(), alone(Option::Earth)),
        ("nadir\"".to_owned(), alone(Option::Nadir)),
        ("subsolar\"".to_owned(), alone(Option::Subsolar)),
        ("optimalLighting\"".to_owned(), alone(Option::OptimalLighting)),
    ]
    .into_iter()
    .chain(Body::ITEMS.iter().map(|it| (format!("body\", body = \"{}\"", it.name), body(it.variant))))
    {
        let found = command(&format!(
            "scenario = \"doubleTarget\"\naimpoint = {{ option = \"{text} }}\nsecondAimpoint = {{ option = \"{text} }}"
        ));
        assert_eq!(found.command.aimpoint, expected, "{text}");
        assert_eq!(found.command.second_aimpoint, expected, "{text}");
    }
}

#[test]
fn every_scenario_takes_what_it_reads() {
    for (text, scenario) in [
        ("plusZ\"\naimpoint = { option = \"earth\" }\nboresight = { instrument = 2 }", Scenario::PlusZ),
        ("nadir\"\naimpoint = { option = \"nadir\" }", Scenario::Nadir),
        (
            "gimbal\"\nboresight = { option = \"gimbal\", angle = 0 }\naimpoint = { option = \"nadir\" }",
            Scenario::Gimbal,
        ),
        ("downlink\"", Scenario::Downlink),
        ("downlink\"\nboresight = { option = \"phasedArray\", azimuth = -1 }", Scenario::Downlink),
        ("downlink\"\nmode = \"safeHold\"", Scenario::Downlink),
        ("limbTerminator\"\nlimb = { height = -100, heightRate = 5 }", Scenario::LimbTerminator),
        ("limbTerminator\"", Scenario::LimbTerminator),
        ("limbGeneric\"\nlimb = { azimuth = 1, reference = \"sun\" }", Scenario::LimbGeneric),
    ] {
        assert_eq!(command(&format!("scenario = \"{text}")).command.scenario, Some(scenario));
    }
    let limb = "scenario = \"limbGeneric\"\nlimb = { azimuth = \"90 deg\", reference = \"sun\", height = \"25 km\", \
                heightRate = \"-0.3 km/s\" }";
    let expected = LimbCommand {
        azimuth_rad: PI / 2.0,
        reference: Some(AzimuthReference::Sun),
        height_m: 25e3,
        height_rate_m_s: -300.0,
    };
    assert_eq!(command(limb).command.limb, expected);
    for (instrument, number) in [("0", 0), ("1", 1), ("2.0", 2), ("\"MASCS\"", 1), ("\"MLA\"", 2)] {
        let text = format!("scenario = \"nadir\"\nboresight = {{ instrument = {instrument} }}");
        assert_eq!(command(&text).command.boresight.instrument, number, "{instrument}");
    }
}

#[test]
fn every_scan_is_read() {
    let rest = "duration = [\"1 min\", 2, 0], pause = [0, 0.5, 0], segments = [3, 0, 1000000], reverse = [true, false, true]";
    let motion = ScanCommand {
        duration_s: [60.0, 2.0, 0.0],
        pause_s: [0.0, 0.5, 0.0],
        segments: [3, 0, 1_000_000],
        reverse: [true, false, true],
        ..ScanCommand::default()
    };
    let rates = "rate = [\"0.1 deg/s\", -2e-3, 0]";
    let speeds = "speed = [\"1 km/s\", -5, 0]";
    let turned =
        |frame| ScanCommand { frame: Some(frame), rate_rad_s: [0.1 * DEG_RAD, -2e-3, 0.0], ..motion };
    let moved = |frame| ScanCommand { frame: Some(frame), speed_m_s: [1e3, -5.0, 0.0], ..motion };
    for (text, expected) in [
        (format!("\"body\", {rates}"), turned(ScanFrame::Body)),
        (format!("\"inertialRotation\", {rates}"), turned(ScanFrame::InertialRotation)),
        (format!("\"inertialTranslation\", {speeds}"), moved(ScanFrame::InertialTranslation)),
        (format!("\"planetTranslation\", {speeds}"), moved(ScanFrame::PlanetTranslation)),
        (
            format!("\"lvlhRotation\", reference = \"sun\", {rates}"),
            ScanCommand { reference: Some(AzimuthReference::Sun), ..turned(ScanFrame::LvlhRotation) },
        ),
    ] {
        let found = command(&format!("scenario = \"nadir\"\nscan = {{ frame = {text}, {rest} }}"));
        assert_eq!(found.command.scan, expected, "{text}");
    }
}

#[test]
fn what_needs_a_device_is_refused_where_there_is_none() {
    let fixed = NamedAntenna {
        name: "dish".to_owned(),
        antenna: Antenna { range: AntennaRange::Axis(Vector3::z()), across_rad: 0.05, along_rad: 0.05 },
    };
    let bare = Spacecraft { instruments: Vec::new(), antennas: Vec::new(), ..spacecraft() };
    let dish = Spacecraft { antennas: vec![fixed], ..bare.clone() };
    let refusal = |spacecraft: &Spacecraft, text: &str| {
        let text = format!("[[command]]\nat = 0\n{text}");
        Timeline::from_toml("t.toml", &text, spacecraft).err().map(|error| error.to_string())
    };
    let earth = "aimpoint = { option = \"earth\" }";
    let generic = |boresight: &str| {
        let roll =
            "bodyRoll = { option = \"vector\", vector = [0, -1, 0] }\nexternalRoll = { option = \"sun\" }";
        format!("scenario = \"generic\"\nboresight = {{ {boresight} }}\n{earth}\n{roll}")
    };
    for (text, found, lack) in [
        ("scenario = \"downlink\"".to_owned(), "the scenario downlink", "[[antennas]]"),
        (
            format!("scenario = \"gimbal\"\nboresight = {{ angle = 0 }}\n{earth}"),
            "the scenario gimbal",
            "gimbal",
        ),
        (
            format!("scenario = \"doubleTarget\"\n{earth}\nsecondAimpoint = {{ option = \"nadir\" }}"),
            "the scenario doubleTarget",
            "[[instruments]] gimbal",
        ),
        (generic("option = \"gimbal\", angle = 0"), "the option gimbal", "[[instruments]] gimbal"),
        (generic("option = \"phasedArray\", azimuth = 0"), "the option phasedArray", "azimuth_deg"),
    ] {
        let error = refusal(&bare, &text).unwrap();
        assert!(error.contains(found) && error.contains(lack), "{text}: {error}");
        assert_eq!(refusal(&spacecraft(), &text), None, "{text}");
    }
    // An antenna that is fixed looks at the Earth but not along an azimuth.
    assert_eq!(refusal(&dish, "scenario = \"downlink\""), None);
    let azimuth = "scenario = \"downlink\"\nboresight = { option = \"phasedArray\", azimuth = 0 }";
    assert!(refusal(&dish, azimuth).unwrap().contains("azimuth_deg"));
}

#[test]
fn modes_and_zones_stand_alone() {
    let entry = command("mode = \"earthAcquisition\"");
    assert_eq!((entry.mode, entry.command), (Some(Mode::EarthAcquisition), PointingCommand::default()));
    assert_eq!(command("mode = \"operational\"").mode, Some(Mode::Operational));
    assert_eq!(command("mode = \"safeHold\"").mode, Some(Mode::SafeHold));
    let zone = command("keepIn = { enabled = false, azimuth = \"90 deg\", elevation = 0 }").keep_in;
    let expected =
        KeepInOverride { enabled: Some(false), azimuth_rad: Some(PI / 2.0), elevation_rad: Some(0.0) };
    assert_eq!(zone, expected);
    let one = KeepInOverride { enabled: Some(true), ..KeepInOverride::default() };
    assert_eq!(command("keepIn = { enabled = true }").keep_in, one);
}

#[test]
fn times_are_dates_or_fmi_time() {
    let two = |first: &str, second: &str| {
        read(&format!(
            "[[command]]\nat = {first}\nscenario = \"nadir\"\n[[command]]\nat = {second}\nscenario = \"downlink\""
        ))
    };
    let fmi = two("-10", "\"90 min\"");
    assert_eq!(fmi.clock, TimelineClock::FmiTime);
    assert_eq!([fmi.entries[0].at_s, fmi.entries[1].at_s], [-10.0, 5400.0]);
    assert_eq!([fmi.entries[0].line, fmi.entries[1].line], [1, 4]);
    // The same instant in both scales, 66.184 s apart within TDB's annual term.
    let dates = two("\"2009-04-06T00:00:00 TDB\"", "\"2009-04-06T00:00:00 UTC\"");
    assert_eq!((dates.clock, dates.entries[0].at_s), (TimelineClock::Epoch, 292_248_000.0));
    assert!((dates.entries[1].at_s - 292_248_066.184).abs() < 2e-3);
    assert_eq!(dates.slot(1.0, 292_248_000.0).entry.unwrap().line, 1);
    assert_eq!(fmi.slot(5400.0, 0.0).entry.unwrap().line, 4);
    assert_eq!(fmi.slot(f64::NAN, 0.0).entry, None);
}

#[test]
fn whole_seconds_of_utc_are_whole_seconds_of_the_simulation_all_year() {
    let epoch_s = |date: &str| crate::environment::dates::epoch_s(date).unwrap();
    let zero_s = epoch_s("2008-03-20T00:00:00 UTC");
    // TDB gains 1.4 ms until October and loses them again.
    let mut largest_s = 0.0_f64;
    for (month, days) in [(4, 12), (6, 73), (8, 134), (10, 195), (12, 256)] {
        let at_s = epoch_s(&format!("2008-{month:02}-01T12:00:00 UTC"));
        let expected_s = f64::from(days) * 86_400.0 + 43_200.0;
        largest_s = largest_s.max((at_s - zero_s - expected_s).abs());
        assert_eq!(simulation_time_s(at_s, zero_s), expected_s, "{month}");
        let later_s = epoch_s(&format!("2008-{month:02}-01T12:00:00.125 UTC"));
        assert!((simulation_time_s(later_s, zero_s) - expected_s - 0.125).abs() < 4e-3);
    }
    assert!(largest_s > 1e-4, "{largest_s}");
    // Dates of TDB are as far from whole seconds as the start is.
    assert_eq!(simulation_time_s(1e8 + 0.184, 0.184), 1e8);
    assert_eq!(simulation_time_s(1e8 + 0.5, 0.25), 1e8 + 0.25);
}

proptest! {
    #[test]
    fn the_entry_in_force_is_found(
        starts in prop::collection::btree_set(-50_i32..50, 1..12),
        ends in prop::collection::vec(prop::option::of(1_i32..20), 12),
    ) {
        let starts: Vec<i32> = starts.into_iter().collect();
        let mut text = String::new();
        let mut spans = Vec::new();
        for (k, start) in starts.iter().enumerate() {
            text += &format!("[[command]]\nat = {start}\nscenario = \"nadir\"\n");
            let next = starts.get(k + 1).copied();
            let end = ends[k].map(|length| next.unwrap_or(i32::MAX).min(start + length));
            text += &end.map(|end| format!("until = {end}\n")).unwrap_or_default();
            spans.push((f64::from(*start), f64::from(end.or(next).unwrap_or(i32::MAX))));
        }
        let timeline = read(&text);
        for half_seconds in -110..110 {
            let now_s = f64::from(half_seconds) * 0.5;
            let expected = spans.iter().position(|(start, end)| (start..end).contains(&&now_s));
            let found = timeline.slot(now_s, 0.0).entry.map(|entry| entry.at_s);
            prop_assert_eq!(found, expected.map(|index| spans[index].0));
        }
    }

    #[test]
    fn no_file_panics(at in 0..EXAMPLE.len(), byte in prop::char::range(' ', '~'), cut in 0..EXAMPLE.len()) {
        if EXAMPLE.is_char_boundary(at) && EXAMPLE.is_char_boundary(at + 1) {
            let mut text = EXAMPLE.to_owned();
            text.replace_range(at..at + 1, &byte.to_string());
            let _ = Timeline::from_toml("t.toml", &text, &spacecraft()).map_err(|error| error.to_string());
        }
        if let Some(torn) = EXAMPLE.get(..cut) {
            let _ = Timeline::from_toml("t.toml", torn, &spacecraft()).map_err(|error| error.to_string());
        }
    }
}

/// `bad_timelines.txt`: files with something wrong, each followed by what is reported of it, indented.
#[test]
fn bad_timelines_are_reported() {
    // Two packages build this file.
    let file = "fmu-src/physics/src/guidance/timeline/bad_timelines.txt";
    let folders = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let path = folders.map(|folder| folder.join(file)).find(|path| path.exists()).unwrap();
    let expected = std::fs::read_to_string(&path).unwrap();
    let cases: Vec<String> = expected
        .split("----\n")
        .map(|case| {
            case.lines().filter(|line| !line.starts_with("    ")).map(|line| format!("{line}\n")).collect()
        })
        .collect();
    assert!(cases.len() > 50);
    let reported = |text: &String| {
        let error = Timeline::from_toml("t.toml", text, &spacecraft()).map(|_| text).unwrap_err();
        error.to_string().lines().fold(text.clone(), |reported, line| format!("{reported}    {line}\n"))
    };
    let found = cases.iter().map(reported).collect::<Vec<_>>().join("----\n");
    if std::env::var_os("UPDATE_SNAPSHOT").is_some() {
        std::fs::write(&path, &found).unwrap();
    }
    assert!(found == expected, "{} is out of step: see UPDATE_SNAPSHOT=1\n{found}", path.display());
}

#[test]
fn a_burn_is_read_with_its_set_and_times() {
    let nominal = |newton: f64| newton / spacecraft().mass_properties.mass_kg;
    let fmi = command(
        "scenario = \"burn\"\nburn = { deltaV = [\"1 km/s\", 2, -3], thrusters = \"lva\", start = \"2 min\", duration = \"1 h\" }",
    );
    let burn = fmi.burn.unwrap();
    assert_eq!(burn.path, VelocityPath::linear(Vector3::new(1000.0, 2.0, -3.0)));
    assert_eq!((burn.start_s, burn.duration_s), (Some(120.0), Some(3600.0)));
    assert_eq!(burn.thrusters, spacecraft().thruster_set("lva"));
    assert!((burn.nominal.acceleration_m_s2 / nominal(660.0) - 1.0).abs() < 1e-12);
    let plain = "scenario = \"burn\"\nburn = { deltaV = [0, 0, 1], thrusters = \"mono4\" }";
    assert_eq!(command(plain).burn.map(|burn| (burn.start_s, burn.duration_s)), Some((None, None)));
    assert_eq!(command("scenario = \"burn\"").burn, None);
    // A date has the clock's own time.
    let dated = read(
        "[[command]]\nat = \"2011-04-06T00:00:00 UTC\"\nscenario = \"burn\"\n\
         burn = { deltaV = [0, 0, 1], thrusters = \"c22\", start = \"2011-04-06T00:10:00 UTC\" }",
    );
    let entry = dated.entries[0];
    assert!((entry.burn.unwrap().start_s.unwrap() - entry.at_s - 600.0).abs() < 1e-3);
    let turn = "scenario = \"burn\"\nburn = { deltaV = [1, 1, 0], profile = [[1, 0, 0], [0, 1, 0], [0, 0, 0]], thrusters = \"c22\" }";
    let curved = VelocityPath::cubic([Vector3::x(), Vector3::y(), Vector3::zeros()]);
    assert_eq!(command(turn).burn.unwrap().path, curved);
}

#[test]
fn downlinks_say_where_the_sun_stands() {
    let place = |text: &str| command(&format!("scenario = \"downlink\"\n{text}")).downlink;
    let at = |azimuth_deg: f64, elevation_deg: f64| {
        let [azimuth_rad, elevation_rad] = [azimuth_deg, elevation_deg].map(|it| it * DEG_RAD);
        Some(crate::attitude::SunAngles { azimuth_rad, elevation_rad })
    };
    assert_eq!(place(""), DownlinkOverride { sun: None, alternate: false });
    let both = place("sun = { azimuth = \"-10 deg\", elevation = \"3 deg\" }\nalternate = true");
    assert_eq!(both, DownlinkOverride { sun: at(-10.0, 3.0), alternate: true });
    assert_eq!(place("sun = { elevation = \"-3 deg\" }").sun, at(0.0, -3.0));
    assert_eq!(command("scenario = \"downlink\"\nstatus = \"free\"").status, PlanStatus::Free);
    assert_eq!(command("scenario = \"nadir\"").status, PlanStatus::Fixed);
}

#[test]
fn panels_and_events_stand_without_commands() {
    let timeline = read(
        "[[panels]]\nat = 0\nsunOffset = \"-40 deg\"\n[[panels]]\nat = \"1 d\"\nsunOffset = [0, \"60 deg\"]\nwindmill = 0.5\n\
         [[event]]\nat = \"2 h\"\ndump = true\n[[event]]\nat = \"3 h\"\ndump = [0, \"20 mN.m.s\", -1]\n\
         maneuver = { deltaV = [1, 0, \"-2 km/s\"] }\ncenterOfMass = [\"1 cm\", 0, 0.1]\n\
         [[event]]\nat = \"4 h\"\nmaneuver = { deltaV = [0, 1, 0], thrusters = \"lva\", dump = false }",
    );
    assert!(timeline.entries.is_empty());
    let [first, second] = &timeline.panels[..] else { panic!("not two") };
    let offset_rad = -40.0 * DEG_RAD;
    assert_eq!((first.at_s, &first.sun_offsets_rad[..]), (0.0, &[offset_rad, offset_rad][..]));
    assert_eq!((second.at_s, second.windmill_rad), (86_400.0, 0.5));
    assert_eq!(second.sun_offsets_rad, [0.0, 60.0 * DEG_RAD]);
    let [dump, maneuver, last] = timeline.events.as_ref() else { panic!("not three") };
    assert_eq!((dump.at_s, dump.dump), (7200.0, Some(TimelineDump::Requested)));
    let to = TimelineDump::To { momentum_body_n_m_s: Vector3::new(0.0, 0.02, -1.0) };
    assert_eq!(
        (maneuver.dump, maneuver.center_of_mass_body_m),
        (Some(to), Some(Vector3::new(0.01, 0.0, 0.1)))
    );
    let expected = TimelineManeuver {
        delta_v_inertial_m_s: Vector3::new(1.0, 0.0, -2000.0),
        thrusters: None,
        dumps: None,
    };
    assert_eq!(maneuver.maneuver, Some(expected));
    let set = spacecraft().thruster_set("lva");
    assert_eq!(last.maneuver.map(|it| (it.thrusters, it.dumps)), Some((set, Some(false))));
}

#[test]
fn no_panel_windmills_without_a_side() {
    let mut spacecraft = spacecraft();
    let text = "[[panels]]\nat = 0\nsunOffset = 0\nwindmill = \"2 deg\"";
    assert!(Timeline::of_plant("t.toml", text, &spacecraft).is_ok());
    spacecraft.panels.iter_mut().for_each(|panel| panel.windmill_side = 0.0);
    let error = Timeline::of_plant("t.toml", text, &spacecraft).unwrap_err().to_string();
    assert!(error.contains("t.toml:4: panels[1].windmill") && error.contains("windmill_side"), "{error}");
}

#[test]
fn panels_over_time_are_as_many_as_commands() {
    let rows = |count: usize| -> String {
        (0..count).map(|at| format!("[[panels]]\nat = {at}\nsunOffset = 0\n")).collect()
    };
    assert_eq!(read(&rows(10_000)).panels.len(), 10_000);
    let error = Timeline::from_toml("t.toml", &rows(10_001), &spacecraft()).unwrap_err().to_string();
    assert!(error.contains("found 10001 entries, allowed: at most 10000"), "{error}");
}

#[test]
fn the_plant_has_neither_burns_nor_modes() {
    for (text, found) in [
        ("scenario = \"burn\"", "command[1].scenario: found the scenario burn"),
        ("mode = \"safeHold\"", "command[1].mode: found the mode safeHold"),
    ] {
        let text = format!("[[command]]\nat = 0\n{text}");
        read(&text);
        let error = Timeline::of_plant("t.toml", &text, &spacecraft()).unwrap_err().to_string();
        assert!(error.contains(found) && error.contains("t.toml:3"), "{error}");
    }
    let text = "[[command]]\nat = 0\nscenario = \"downlink\"\n[[event]]\nat = 5\ndump = true";
    assert!(Timeline::of_plant("t.toml", text, &spacecraft()).is_ok());
}
