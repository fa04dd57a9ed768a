//! Defaults of the least file, units of the fullest.

use physics::constants::DAY_S;

use super::*;

fn parsed(text: &str) -> Result<PlanFile, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mission.toml"), "stop = 1\n").unwrap();
    let file = folder.path().join("plan.toml");
    reading::parse([&file; 2], text.to_owned(), judge).map_err(String::from)
}

#[test]
fn the_least_file_has_defaults() {
    let plan = parsed("mission = \"mission.toml\"\n").unwrap();
    assert_eq!([plan.freeze_s.it, plan.window_s.it], [14.0 * DAY_S, 3.0 * DAY_S]);
    assert_eq!(
        [plan.momentum.margin, plan.alternation.it, plan.contact_share.it, plan.offset_rad()],
        [0.0, 0.5, 0.0, 0.0]
    );
    assert_eq!([plan.tilt.azimuth_rad, plan.tilt.elevation_rad], [None, None]);
    assert!(plan.of_cruise().next().is_none());
    assert!((plan.windmill_rad.it - 2.0_f64.to_radians()).abs() < 1e-15 && !plan.windmill_rad.is_written);
    assert!(plan.momentum.limit_n_m_s.is_none() && plan.momentum.refit.is_none() && plan.momentum.dumps == 0);
}

#[test]
fn units_are_read() {
    let plan = parsed(
        "mission = \"mission.toml\"\nfreeze = \"12 h\"\nwindow = 86400\nwindmill = \"0.01 rad\"\n\
         [momentum]\nlimit = \"4 N.m.s\"\ndumps = 2\n[sunOffset]\nchange = true\nlargest = \"3 deg\"\n\
         [[contact]]\nstart = \"1 d\"\nstop = \"30 h\"\n\
         [[activity]]\nname = \"a\"\nstart = \"2008-04-01 UTC\"\nstop = \"2008-04-02 UTC\"\n\
         command = { scenario = \"downlink\", sun = { azimuth = \"1 deg\" }, alternate = true }\n",
    )
    .unwrap();
    assert_eq!([plan.freeze_s.it, plan.window_s.it], [43_200.0, DAY_S]);
    let of_cruise: Vec<_> = plan.of_cruise().map(|at| (at.key, at.line)).collect();
    let expected = [("window", 3), ("windmill", 4), ("sunOffset", 8), ("contact", 11)];
    assert_eq!(of_cruise, expected.map(|(key, line)| (key.to_owned(), line)));
    let momentum = &plan.momentum;
    assert_eq!((plan.windmill_rad.it, momentum.limit_n_m_s, momentum.dumps), (0.01, Some(4.0), 2));
    assert!((plan.offset_rad() - 3.0_f64.to_radians()).abs() < 1e-15);
    let contact = &plan.contacts.it[0].it;
    assert_eq!([contact.start, contact.stop], [Instant::Time(DAY_S), Instant::Time(108_000.0)]);
    let command = &plan.activities[0].it.command;
    assert_eq!(command, "alternate = true\nscenario = \"downlink\"\nsun = { azimuth = \"1 deg\" }\n");
}

#[test]
fn every_mistake_is_reported_with_its_line() {
    let refused =
        parsed("mission = \"none.toml\"\nwindow = 1\nalternation = \"half\"\nwidnmill = 0\n").unwrap_err();
    for expected in
        [":1: mission: found ", ":2: window: found 1", ":3: alternation: found \"half\"", ":4: widnmill"]
    {
        assert!(refused.contains(expected), "{expected}: {refused}");
    }
}
