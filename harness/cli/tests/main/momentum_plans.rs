//! `heliotorque plan` of a plan of momentum: a cruise planned and simulated below its limit, what no plan holds, prices, and what is refused.

use std::{fs, path::Path};

use crate::{run, says, shown, template};

const RESOURCES: &str = "../../fmu-src/resources";

/// The cruise with its spacecraft and timeline in a folder of its own, edited.
pub(crate) fn cruise(folder: &Path, edits: &[(&str, &str)]) {
    let read = |name: &str| fs::read_to_string(Path::new(RESOURCES).join(name)).unwrap();
    fs::write(folder.join("messenger.toml"), read("messenger.toml")).unwrap();
    let timeline = read("examples/missions/messenger-cruise-timeline.toml");
    let mut mission = read("examples/missions/messenger-cruise.toml");
    mission = mission.replace("../../messenger.toml", "messenger.toml");
    for (old, new) in edits {
        assert!(mission.contains(old) || timeline.contains(old), "{old}");
        mission = mission.replace(old, new);
    }
    let mut edited = timeline;
    for (old, new) in edits {
        edited = edited.replace(old, new);
    }
    fs::write(folder.join("messenger-cruise-timeline.toml"), edited).unwrap();
    fs::write(folder.join("cruise.toml"), mission).unwrap();
}

/// Plans a text in the folder; what is said.
#[track_caller]
fn plan(folder: &Path, template: &Path, text: &str, status: i32) -> String {
    let file = folder.join("plan.toml");
    fs::write(&file, text).unwrap();
    let output = folder.join("out");
    run(&["plan", shown(&file), "--output", shown(&output), "--template", shown(template)], status)
}

/// A number behind a key of plan.json.
fn number(folder: &Path, key: &str) -> f64 {
    let text = fs::read_to_string(folder.join("out/plan.json")).unwrap();
    let rest = text.split_once(&format!("\"{key}\": ")).unwrap_or_else(|| panic!("{key}: {text}")).1;
    rest.split([',', '\n', '}']).next().unwrap().trim().parse().unwrap_or_else(|_| panic!("{key}: {text}"))
}

/// Columns of a CSV by name.
pub(crate) fn columns(file: &Path, names: &[&str]) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let at: Vec<usize> = names.iter().map(|name| header.iter().position(|it| it == name).unwrap()).collect();
    let value = |cell: &str| match cell {
        "true" => 1.0,
        "false" => 0.0,
        number => number.parse().unwrap(),
    };
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            at.iter().map(|index| value(cells[*index])).collect()
        })
        .collect()
}

/// Simulates the mission that was written, and its input table with steps that meet its times: the same momentum at every hour. How many
/// hours have an event, which a table requests where the next step begins.
fn table_is_timeline(folder: &Path, template: &Path) -> usize {
    let mission = folder.join("out/mission.toml");
    let text = fs::read_to_string(&mission).unwrap();
    let table = text.replace("timeline = \"timeline.toml\"\n", "").replace("\"timeline\"", "\"command\"");
    fs::write(folder.join("out/table.toml"), table).unwrap();
    let (inputs, table) = (folder.join("out/plan.csv"), folder.join("out/table.toml"));
    let by_table = ["--input", shown(&inputs), "--step", "60s"];
    let names = [
        "momentum.inertial[1]",
        "momentum.inertial[2]",
        "momentum.inertial[3]",
        "dump.count",
        "maneuver.count",
    ];
    let [timeline, table] = [(&mission, &[][..]), (&table, &by_table)].map(|(mission, more)| {
        let output = folder.join("twin.csv");
        let arguments = [
            "run",
            shown(mission),
            "--template",
            shown(template),
            "--every",
            "1h",
            "--record",
            &names.join(","),
        ];
        run(&[&arguments[..], more, &["--output", shown(&output)]].concat(), 0);
        columns(&output, &names)
    });
    assert_eq!(timeline.len(), table.len());
    let mut events = 0;
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (row, twin) in timeline.iter().zip(&table) {
        if row[3..] != twin[3..] {
            events += 1;
            continue;
        }
        let [apart, momentum] = [twin.as_slice(), &[0.0; 3]]
            .map(|from| (0..3).map(|axis| (row[axis] - from[axis]).powi(2)).sum::<f64>().sqrt());
        (worst, largest) = (worst.max(apart), largest.max(momentum));
    }
    println!("{worst:e} of {largest}");
    assert!(worst <= 1e-9 * largest && largest > 1.0, "{worst:e} {largest}");
    assert_eq!(timeline.last().unwrap()[3..], table.last().unwrap()[3..]);
    events
}

const PLAN: &str = "mission = \"cruise.toml\"\n[momentum]\nlimit = 5.5\n[tilt]\nazimuth = \"5 deg\"\nelevation = \"5 deg\"\n";
const OFF: &str = "mission = \"cruise.toml\"\nwindmill = 0\nalternation = 0\n[momentum]\nlimit = 5.5\n";

/// The mission left alone comes to 43 N m s; planned it stays below 5.5 at every hour, with arrays in their corridor.
#[test]
fn a_cruise_is_planned_and_simulated_below_its_limit() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[]);
    let printed = plan(folder, &template, PLAN, 0);
    says(
        &printed,
        &["|H| as the mission is: 42.9", "dumps: 0", "7 changes of the arrays; no plan has fewer"],
    );
    assert!(number(folder, "planned") < 5.5 && number(folder, "simulated") < 5.5);
    assert!(number(folder, "largestDifference_n_m_s") < 0.02 * 5.5);
    assert_eq!([number(folder, "changes"), number(folder, "changesAtLeast")], [7.0, 7.0]);
    // As the mission that was written simulates it.
    let simulated = folder.join("simulated.csv");
    let mission = folder.join("out/mission.toml");
    let names = "momentum.inertial,panel*.corridorMargin,downlink.clamped,dump.count";
    run(
        &[
            "run",
            shown(&mission),
            "--template",
            shown(&template),
            "--record",
            names,
            "--every",
            "1h",
            "--output",
            shown(&simulated),
        ],
        0,
    );
    let rows = columns(
        &simulated,
        &[
            "momentum.inertial[1]",
            "momentum.inertial[2]",
            "momentum.inertial[3]",
            "panel[1].corridorMargin",
            "panel[2].corridorMargin",
            "downlink.clamped",
            "dump.count",
        ],
    );
    assert_eq!(rows.len(), 4801);
    for row in &rows {
        let momentum = (row[0] * row[0] + row[1] * row[1] + row[2] * row[2]).sqrt();
        assert!(
            momentum < 5.5 && row[3] >= 0.0 && row[4] >= 0.0 && row[5] == 0.0 && row[6] == 0.0,
            "{row:?}"
        );
    }
    assert_eq!(table_is_timeline(folder, &template), 0);
    // What it wrote can be planned again.
    let again = "mission = \"out/mission.toml\"\n[momentum]\nlimit = 6\n";
    let output = folder.join("again");
    fs::write(folder.join("again.toml"), again).unwrap();
    let file = folder.join("again.toml");
    let arguments =
        ["plan", shown(&file), "--output", shown(&output), "--template", shown(&template), "--quiet"];
    run(&arguments, 0);
}

/// Month by month, each plan made of the one before: the arrays move no more often over the whole cruise.
#[test]
fn planning_again_never_raises_the_number_of_changes() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[("stop = \"200 d\"", "stop = \"60 d\"")]);
    plan(folder, &template, PLAN, 0);
    let steps =
        || fs::read_to_string(folder.join("out/timeline.toml")).unwrap().matches("[[panels]]").count();
    let mut before = (steps(), number(folder, "changes"));
    for freeze_d in [30, 45] {
        for name in ["mission.toml", "timeline.toml"] {
            fs::copy(folder.join("out").join(name), folder.join(name)).unwrap();
        }
        let mission = fs::read_to_string(folder.join("mission.toml")).unwrap();
        fs::write(folder.join("mission.toml"), mission.replace("../messenger.toml", "messenger.toml"))
            .unwrap();
        let again = PLAN.replace("cruise.toml\"", &format!("mission.toml\"\nfreeze = \"{freeze_d} d\""));
        plan(folder, &template, &again, 0);
        let now = (steps(), number(folder, "changes"));
        assert!(now.0 <= before.0 && now.1 <= before.1, "day {freeze_d}: {now:?} for {before:?}");
        assert!(number(folder, "simulated") <= 5.5);
        before = now;
    }
}

#[test]
fn without_controls_the_least_dumps_and_the_first_day_are_reported() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[]);
    let printed = plan(folder, &template, OFF, 1);
    says(&printed, &["no plan holds without a dump: 5 at least on this baseline", "first on day 19."]);
    assert_eq!([number(folder, "dumps"), number(folder, "dumpsAtLeast")], [5.0, 5.0]);
    assert!((number(folder, "excess_n_m_s") - 37.5).abs() < 0.2);
    assert!((19.0..20.0).contains(&number(folder, "firstDay")));
    let text = fs::read_to_string(folder.join("out/plan.json")).unwrap();
    assert!(
        text.contains("\"status\": \"infeasible\"") && text.contains("\"limit\": \"momentum\""),
        "{text}"
    );
    // With them allowed it is a plan, whose flight stays below the limit.
    let printed = plan(folder, &template, &OFF.replace("limit = 5.5", "limit = 5.5\ndumps = 5"), 0);
    assert!(printed.contains("dumps on days "), "{printed}");
    assert!(number(folder, "simulated") < 5.5);
    assert_eq!(table_is_timeline(folder, &template), 5);
}

/// Maneuvers, dumps, centres of mass and panels of the mission are in the input table of its plan, at dates that are its steps'.
#[test]
fn the_missions_events_are_in_the_input_table() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[("stop = \"200 d\"", "stop = \"60 d\"")]);
    let timeline = folder.join("messenger-cruise-timeline.toml");
    let panels = "at = \"2008-03-20T00:00:00 UTC\"      # 0.70 AU\nsunOffset = \"5 deg\"\n";
    let more = format!(
        "{panels}\n[[panels]]\nat = \"2008-03-29T07:00:00 UTC\"\nsunOffset = \"4 deg\"\nwindmill = \"1 deg\"\n"
    );
    let text = fs::read_to_string(&timeline).unwrap();
    assert!(text.contains(panels));
    let events = "\n[[event]]\nat = \"2008-03-25T06:00:00 UTC\"\ndump = [0.123456789, -0.2, 0.3]\n\
                  [[event]]\nat = \"2008-03-28T12:00:00 UTC\"\nmaneuver = { deltaV = [0.5, -1, 0.2] }\n\
                  [[event]]\nat = \"2008-04-16T00:00:00 UTC\"\nmaneuver = { deltaV = [1, 0, 0] }\ndump = [0.1, 0.2, -0.3]\n\
                  [[event]]\nat = \"2008-04-20T03:00:00 UTC\"\ncenterOfMass = [0.002, 0.001, -0.024]\n\
                  [[event]]\nat = \"2008-05-01T00:00:00 UTC\"\ndump = true\n";
    fs::write(&timeline, text.replace(panels, &more) + events).unwrap();
    let printed = plan(folder, &template, PLAN, 0);
    assert!(!printed.contains("warning"), "{printed}");
    let header = fs::read_to_string(folder.join("out/plan.csv")).unwrap();
    let header = header.lines().next().unwrap();
    says(
        header,
        &["maneuver.request,maneuver.deltaV[1]", "dump.request,dump.target[1]", "spacecraft.centerOfMass[3]"],
    );
    assert_eq!(table_is_timeline(folder, &template), 4);
    // Parameters of the flight are no inputs.
    let own = events.replace("0.2] }", "0.2], dump = false }");
    fs::write(&timeline, fs::read_to_string(&timeline).unwrap().replace(events, &own)).unwrap();
    let printed = plan(folder, &template, PLAN, 0);
    assert!(printed.contains("warning: plan.csv: the maneuver of day 8.5 is without a dump"), "{printed}");
}

/// Contacts hold no alternate attitude; a planned command and an activity have their price.
#[test]
fn contacts_are_kept_and_prices_reported() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[("stop = \"200 d\"", "stop = \"60 d\"")]);
    let timeline = folder.join("messenger-cruise-timeline.toml");
    let planned = "\n[[command]]\nat = \"2008-04-20T00:00:00 UTC\"\nuntil = \"2008-04-22T00:00:00 UTC\"\nscenario = \"downlink\"\n\
                   sun = { azimuth = \"8 deg\" }\nstatus = \"planned\"\n";
    fs::write(&timeline, fs::read_to_string(&timeline).unwrap() + planned).unwrap();
    let contacts: String =
        (14..60).map(|day| format!("[[contact]]\nstart = \"{day}.25 d\"\nstop = \"{day}.5 d\"\n")).collect();
    let activity = "[[activity]]\nname = \"calibration\"\nstart = \"40 d\"\nstop = \"42 d\"\n\
                    command = { scenario = \"downlink\", sun = { elevation = \"10 deg\" } }\n";
    let printed = plan(folder, &template, &format!("{PLAN}{contacts}{activity}"), 0);
    says(&printed, &["without planned command 1: ", "with calibration: ", "dumps: 0"]);
    let text = fs::read_to_string(folder.join("out/timeline.toml")).unwrap();
    assert!(text.contains("status = \"planned\"") && text.contains("alternate = true"), "{text}");
    let rows = columns(&folder.join("out/plan.csv"), &["time", "downlink.alternate"]);
    for pair in rows.windows(2) {
        let [from_d, to_d] = [pair[0][0], pair[1][0]].map(|time_s| time_s / 86_400.0);
        let meets = (14..60).map(f64::from).any(|day| from_d < day + 0.5 - 1e-9 && to_d > day + 0.25 + 1e-9);
        assert!(pair[0][1] == 0.0 || to_d - from_d < 1e-9 || !meets, "{pair:?}");
    }
}

/// A refit's values are simulated, three sigma of its covariance are left; other seeds move the centre of mass at every dump.
#[test]
fn a_refit_is_simulated_and_leaves_its_margin() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[("stop = \"200 d\"", "stop = \"40 d\"")]);
    let refit = "{\"centerOfMass_m\": [0.001, 0.0, -0.025], \"scale\": 1.01, \"covariance\": \
                 [[1e-8,0,0,0],[0,1e-8,0,0],[0,0,1e-8,0],[0,0,0,1e-4]]}";
    fs::write(folder.join("refit.json"), refit).unwrap();
    let text = PLAN.replace("limit = 5.5", "limit = 5.5\nrefit = \"refit.json\"");
    plan(folder, &template, &text, 0);
    let mission = fs::read_to_string(folder.join("out/mission.toml")).unwrap();
    assert!(mission.contains("\"spacecraft.centerOfMass\" = [0.001, 0.0, -0.025]"), "{mission}");
    assert!(mission.contains("\"solar.scale\" = 1.01") && !mission.contains("centerOfMass[3]"), "{mission}");
    // One per cent of the light for 14 d alone is 0.13 N m s at three sigma.
    assert!(number(folder, "simulated") < 5.4);
    let event = "\n[[event]]\nat = \"2008-04-10T00:00:00 UTC\"\ndump = true\n";
    let timeline = folder.join("messenger-cruise-timeline.toml");
    fs::write(&timeline, fs::read_to_string(&timeline).unwrap() + event).unwrap();
    let shift = "[set]\n\"spacecraft.centerOfMassShift\" = [0.002, 0.002, 0.002]";
    let cruise = folder.join("cruise.toml");
    fs::write(&cruise, fs::read_to_string(&cruise).unwrap().replace("[set]", shift)).unwrap();
    fs::write(folder.join("plan.toml"), PLAN).unwrap();
    let (file, output) = (folder.join("plan.toml"), folder.join("out"));
    let arguments = ["plan", shown(&file), "--output", shown(&output), "--template"];
    let printed = run(&[&arguments[..], &[shown(&template), "--seeds", "5"]].concat(), 0);
    assert!(printed.contains("5 seeds: |H| "), "{printed}");
    let text = fs::read_to_string(folder.join("out/plan.json")).unwrap();
    let momentum = text.split_once("\"momentum_n_m_s\": {").unwrap().1;
    let percentile = |key: &str| -> f64 {
        let rest = momentum.split_once(&format!("\"{key}\": ")).unwrap().1;
        rest.split([',', '\n']).next().unwrap().trim().parse().unwrap()
    };
    assert!(percentile("99") > percentile("50"), "{text}");
}

#[test]
fn what_cannot_be_planned_is_refused_by_line() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    cruise(folder, &[("stop = \"200 d\"", "stop = \"40 d\"")]);
    for (text, expected) in [
        (PLAN.replace("cruise.toml", "none.toml"), "plan.toml:1: mission: found "),
        (
            format!("freeze = \"40 d\"\n{PLAN}"),
            "plan.toml:1: freeze: found 40 d, no less than the mission's 40 d",
        ),
        (
            format!("window = \"10 min\"\n{PLAN}"),
            "plan.toml:1: window: found \"10 min\", allowed: a time from 1 h on",
        ),
        (
            format!("windmill = 2\n{PLAN}"),
            "plan.toml:1: windmill: found 2, allowed: an angle from 0 to 90 deg",
        ),
        (
            format!("alternation = 1.5\n{PLAN}"),
            "plan.toml:1: alternation: found 1.5, allowed: a share from 0 to 1",
        ),
        (
            PLAN.replace("5.5", "\"5.5 N.m\""),
            "plan.toml:3: momentum.limit: found \"5.5 N.m\", allowed: a number of N.m.s",
        ),
        (
            format!("{PLAN}[[contact]]\nstart = \"20 d\"\nstop = \"20 d\"\n"),
            "plan.toml:9: contact[1].stop: found \"20 d\", not after `start`",
        ),
        (
            format!(
                "{PLAN}[[contact]]\nstart = 0\nstop = \"20 d\"\n[[contact]]\nstart = \"19 d\"\nstop = \"21 d\"\n"
            ),
            "before the contact above ends",
        ),
        (
            format!("contactShare = 0.5\n{PLAN}[[contact]]\nstart = 0\nstop = 1\n"),
            "contactShare beside [[contact]]",
        ),
        (
            format!(
                "{PLAN}[[activity]]\nname = \"a\"\nstart = \"1 d\"\nstop = \"2 d\"\ncommand = {{ scenario = \"downlink\" }}\n"
            ),
            "found a time that the mission holds fixed",
        ),
        (
            PLAN.replace("limit = 5.5", "limit = 5.5\nrefit = \"cruise.toml\""),
            "plan.toml:4: momentum.refit: found ",
        ),
    ] {
        let printed = plan(folder, &template, &text, 2);
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    // What the mission does not allow.
    for (edit, expected, status) in [
        (
            ("\"cruise\"", "\"orbit\""),
            "plan.toml:1: mission: found no downlink, allowed: a mission with downlinks",
            2,
        ),
        (
            ("[set]", "[set]\n\"momentum.strategy\" = \"reactive\""),
            "momentum.strategy: found reactive, allowed: dumpsOnly",
            2,
        ),
        (
            ("[set]", "[set]\n\"articulation.minimumSuns\" = 2.2"),
            "articulation: found nothing between 2.2 and 4.2 suns",
            1,
        ),
    ] {
        cruise(folder, &[("stop = \"200 d\"", "stop = \"40 d\""), edit]);
        let printed = plan(folder, &template, PLAN, status);
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    assert!(fs::read_to_string(folder.join("out/plan.json")).unwrap().contains("\"limit\": \"corridor\""));
    // Panels that no windmill angle turns.
    cruise(folder, &[("stop = \"200 d\"", "stop = \"40 d\"")]);
    let spacecraft = folder.join("messenger.toml");
    let text = fs::read_to_string(&spacecraft).unwrap();
    fs::write(&spacecraft, text.replace("[[panels]]", "[[panels]]\nwindmill_side = 0")).unwrap();
    let printed = plan(folder, &template, &format!("windmill = \"1 deg\"\n{PLAN}"), 2);
    assert!(printed.contains("plan.toml:1: windmill: found panels without a side"), "{printed}");
    // Contacts where alternation is needed.
    cruise(folder, &[("stop = \"200 d\"", "stop = \"60 d\"")]);
    let only = "mission = \"cruise.toml\"\nwindmill = 0\n[momentum]\nlimit = 5.5\n";
    plan(folder, &template, only, 0);
    let printed =
        plan(folder, &template, &format!("{only}[[contact]]\nstart = \"15 d\"\nstop = \"45 d\"\n"), 1);
    assert!(printed.contains("plan.toml:5: contact[1]: found contacts that fill the window"), "{printed}");
}

/// 20 d about Mercury whose momentum reaches 4 N m s, with further values.
fn about_mercury(folder: &Path, more: &str) {
    fs::copy(Path::new(RESOURCES).join("messenger.toml"), folder.join("messenger.toml")).unwrap();
    let mission = "spacecraft = \"messenger.toml\"\nmodel = \"MomentumPlant\"\nstart = \"2011-04-06T00:00:00 UTC\"\n\
                   stop = \"20 d\"\nstep = \"10 min\"\n\
                   record = [\"momentum.*\", \"attitude.q\", \"dump.count\", \"downlink.active\", \"downlink.clamped\"]\n\
                   [set]\n\"orbit.center\" = \"mercury\"\n\"spacecraft.centerOfMass[3]\" = \"-2.54 cm\"\n\"dump.threshold\" = [4, 4, 4]\n";
    fs::write(folder.join("orbit.toml"), format!("{mission}{more}")).unwrap();
}

/// Momentum whose body components are integrated has no length that means anything: each component stays below the limit.
#[test]
fn momentum_of_body_components_is_held_by_component() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    about_mercury(folder, "\"momentum.convention\" = \"bodyIntegral\"\n");
    let text = "mission = \"orbit.toml\"\nfreeze = 0\n[momentum]\nlimit = 4\n";
    let printed = plan(folder, &template, text, 0);
    says(&printed, &["largest component of H as the mission is: ", "dumps: 0"]);
    let (mission, simulated) = (folder.join("out/mission.toml"), folder.join("simulated.csv"));
    run(&["run", shown(&mission), "--output", shown(&simulated), "--template", shown(&template)], 0);
    let names = ["momentum.body[1]", "momentum.body[2]", "momentum.body[3]"];
    let rows = columns(&simulated, &names);
    let component = rows.iter().flatten().fold(0.0_f64, |most, it| most.max(it.abs()));
    let length = rows.iter().map(|row| row.iter().map(|it| it * it).sum::<f64>().sqrt()).fold(0.0, f64::max);
    println!("component {component}, length {length}, plan {}", number(folder, "simulated"));
    // The momentum lies nearly along an axis: by its length the plan would say 8e-3 N m s more.
    assert!((component - number(folder, "simulated")).abs() < 1e-6 && length > component + 5e-3);
    assert!(number(folder, "largestDifference_n_m_s") < 0.02 * 4.0);
}

/// About Mercury the mission left alone dumps; with the Sun's places of a plan it does not, whether they are commanded or put in, none of
/// them clamped, and science is as it was.
#[test]
fn downlinks_of_an_orbit_phase_hold_the_momentum() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    about_mercury(folder, "");
    let printed = plan(folder, &template, "mission = \"orbit.toml\"\nfreeze = 0\n", 0);
    says(&printed, &["dumps: 0", "places of the Sun in 20 downlinks"]);
    assert!(number(folder, "simulated") < 0.6 * 4.0);
    assert!(number(folder, "largestDifference_n_m_s") < 0.02 * 4.0);
    let by_input = fs::read_to_string(folder.join("out/mission.toml")).unwrap();
    let by_input = by_input.replace("timeline = \"timeline.toml\"", "inputs = \"plan.csv\"");
    fs::write(folder.join("out/by-input.toml"), by_input).unwrap();
    let names = [
        "momentum.inertial[1]",
        "momentum.inertial[2]",
        "momentum.inertial[3]",
        "dump.count",
        "downlink.active",
        "downlink.clamped",
        "attitude.q[1]",
    ];
    let [alone, commanded, put_in] = ["orbit.toml", "out/mission.toml", "out/by-input.toml"].map(|mission| {
        let simulated = folder.join("simulated.csv");
        let mission = folder.join(mission);
        run(&["run", shown(&mission), "--output", shown(&simulated), "--template", shown(&template)], 0);
        columns(&simulated, &names)
    });
    let length = |row: &Vec<f64>| row[..3].iter().map(|it| it * it).sum::<f64>().sqrt();
    assert!(alone.last().unwrap()[3] > 0.0);
    let greatest = commanded.iter().map(length).fold(0.0, f64::max);
    assert!((greatest - number(folder, "simulated")).abs() < 1e-6);
    for ((was, row), other) in alone.iter().zip(&commanded).zip(&put_in) {
        assert_eq!([row[3], row[5], other[3], other[5]], [0.0; 4]);
        assert!((0..3).all(|axis| (row[axis] - other[axis]).abs() < 1e-6));
        assert_eq!(was[4], row[4], "a downlink elsewhere");
        assert!(row[4] != 0.0 || (was[6] - row[6]).abs() < 1e-9, "science in another attitude");
    }
    // Commands end in the last minute of their downlinks.
    let (mission, minutes) = (folder.join("orbit.toml"), folder.join("minutes.csv"));
    let by_minute = ["run", shown(&mission), "--step", "1min", "--record", "downlink.active"];
    let rest = ["--output", shown(&minutes), "--template", shown(&template)];
    run(&[&by_minute[..], &rest].concat(), 0);
    let active = columns(&minutes, &["downlink.active"]).concat();
    let windows = fs::read_to_string(folder.join("out/windows.csv")).unwrap();
    for window in windows.lines().filter(|line| line.contains(",free,")) {
        let stop_s: f64 = window.split(',').nth(1).unwrap().parse().unwrap();
        let minute = (stop_s / 60.0) as usize;
        assert!(stop_s % 60.0 == 0.0 && active[minute..minute + 2] == [1.0, 0.0], "{window}");
    }
    // What does not count there is refused with its line.
    let printed = plan(folder, &template, "mission = \"orbit.toml\"\nfreeze = 0\nwindmill = \"2 deg\"\n", 2);
    says(&printed, &["plan.toml:3: windmill: found it, allowed: none in an orbit phase"]);
}
