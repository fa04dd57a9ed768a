//! What MESSENGER's plant and changes of it say of where it points.

use super::*;

fn sentence(sets: &[(&str, f64)]) -> (String, Vec<String>) {
    sentence_of(sets, None)
}

fn sentence_of(sets: &[(&str, f64)], windows: Option<DownlinkWindows>) -> (String, Vec<String>) {
    let xml = include_str!("../../../../modelDescription/golden/MomentumPlant.xml");
    let description = model_description::parse(xml.as_bytes()).unwrap().description;
    let sets = sets.iter().map(|(name, value)| {
        let is_real = real(&description, &[], name).is_some();
        ((*name).to_owned(), if is_real { Value::Real(*value) } else { Value::Integer(*value as i32) })
    });
    let sets: Vec<_> = sets.collect();
    let windows: Vec<Windows> = windows.map(|windows| (String::new(), windows)).into_iter().collect();
    let sentence = plants(&description, &sets, &windows).next().unwrap().sentence().unwrap();
    (sentence, warnings(&description, &sets, &windows))
}

const HOUR_S: f64 = 3600.0;

#[test]
fn each_rule_and_window_has_its_words() {
    let scaled = "-Y at the Sun, +Z pitched toward nadir by 0.25 of the way, at most 13 deg";
    assert_eq!(
        sentence(&[]),
        (format!("{scaled}, downlink from 2 h to 10 h after one of 2 periapses"), vec![])
    );
    let nadir = [("guided.scienceRule", 2.0), ("guided.downlinkEvery", 0.0)];
    assert_eq!(sentence(&nadir).0, "nadir with +Z, the Sun within 13 deg of -Y, no downlinks");
    let free = [nadir[0], nadir[1], ("keepIn.elevation", core::f64::consts::FRAC_PI_2)];
    assert_eq!(sentence(&free).0, "nadir with +Z, rolled so that the Sun is nearest to -Y, no downlinks");
    assert_eq!(sentence(&[("orbit.center", 2.0)]).0, "-Y at the Sun, +Z toward the north, no downlinks");
    assert_eq!(
        sentence(&[("attitude.source", 4.0)]).0,
        "as its wheels and thrusters turn it (attitude.source free)"
    );
    let once = [("guided.downlinkReference", 2.0), ("guided.downlinkEvery", 0.0)];
    assert_eq!(sentence(&once).0, format!("{scaled}, one downlink from 2 h to 10 h after the start"));
}

#[test]
fn a_window_as_long_as_its_cycle_is_warned_of_where_the_plant_guides_itself() {
    let warned = |sets: &[(&str, f64)]| sentence(sets).1;
    let end = |hours: f64| ("guided.downlinkEnd", hours * HOUR_S);
    assert!(warned(&[end(25.9)]).is_empty());
    let always = warned(&[end(26.1)]);
    assert!(always.len() == 1 && always[0].contains("every 24 h is always open"), "{always:?}");
    let never = warned(&[end(2.0)]);
    assert!(never.len() == 1 && never[0].contains("from 2 h to 2 h every 24 h is never open"), "{never:?}");
    // 500 km above Venus a period is 2 pi sqrt(6551.8^3 / 324859) s = 1.6239 h.
    let venus = [("orbit.center", 3.0), ("orbit.semiMajorAxis", 6551.8e3)];
    assert!(warned(&venus)[0].contains("every 3.248 h is always open"), "{:?}", warned(&venus));
    for silent in [("guided.downlinkEvery", 0.0), ("attitude.source", 4.0), ("orbit.center", 2.0)] {
        assert!(warned(&[end(26.1), silent]).is_empty(), "{silent:?}");
    }
}

#[test]
fn shares_of_the_period_follow_the_orbit_that_is_set() {
    let share = TimeAfterPeriapsis::PeriodShare;
    let windows = |stop: f64| Some(DownlinkWindows { start: share(0.2), stop: share(stop), every: 1 });
    let low = [("orbit.center", 3.0), ("orbit.semiMajorAxis", 6551.8e3), ("guided.downlinkEvery", 1.0)];
    let (sentence, warned) = sentence_of(&low, windows(0.5));
    assert!(sentence.ends_with("downlink from 20 % to 50 % after every periapsis"), "{sentence}");
    assert!(warned.is_empty(), "{warned:?}");
    let (_, warned) = sentence_of(&low, windows(1.3));
    assert!(warned.len() == 1 && warned[0].contains("always open"), "{warned:?}");
    // Set, a time is that.
    let (sentence, warned) =
        sentence_of(&[&low[..], &[("guided.downlinkEnd", 5400.0)]].concat(), windows(0.5));
    assert!(sentence.ends_with("from 20 % to 1.5 h after every periapsis"), "{sentence}");
    assert!(warned.is_empty(), "{warned:?}");
}
