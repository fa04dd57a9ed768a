//! Defaults of the least file, units of the fullest.

use super::*;

fn parsed(text: &str) -> Result<PlanFile, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mission.toml"), "stop = 1\n").unwrap();
    let file = folder.path().join("plan.toml");
    reading::parse(&file, text, |builder, it| builder.plan(&file, it))
}

#[test]
fn the_least_file_has_defaults() {
    let plan = parsed("mission = \"mission.toml\"\n").unwrap();
    assert_eq!([plan.freeze_s.it, plan.window_s.it], [14.0 * DAY_S, 3.0 * DAY_S]);
    assert_eq!([plan.margin, plan.alternation, plan.contact_share, plan.offset_rad], [0.0, 0.5, 0.0, 0.0]);
    assert_eq!([plan.azimuth_rad, plan.elevation_rad], [None, None]);
    assert!(plan.of_cruise.is_empty());
    assert!((plan.windmill_rad.0 - 2.0_f64.to_radians()).abs() < 1e-15 && plan.windmill_rad.1.is_none());
    assert!(plan.limit_n_m_s.is_none() && plan.refit.is_none() && plan.dumps == 0);
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
    let of_cruise: Vec<_> = plan.of_cruise.iter().map(|at| (at.key.as_str(), at.line)).collect();
    assert_eq!(of_cruise, [("window", 3), ("windmill", 4), ("sunOffset", 8), ("contact", 11)]);
    assert_eq!((plan.windmill_rad.0, plan.limit_n_m_s, plan.dumps), (0.01, Some(4.0), 2));
    assert!((plan.offset_rad - 3.0_f64.to_radians()).abs() < 1e-15);
    assert_eq!(plan.contacts[0].it, [values::Instant::Time(DAY_S), values::Instant::Time(108_000.0)]);
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
