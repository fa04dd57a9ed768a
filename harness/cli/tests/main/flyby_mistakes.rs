//! Refusals of `plan` with `[flyby]` before its first flight.

use std::fs;

use crate::{flybys::plan, legs::flyby, says, template};

/// Each with line, key, what was found and what is allowed.
#[test]
fn aims_and_states_that_cannot_be_are_refused() {
    let Some((_packed, template)) = template() else { return };
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flyby(folder, 2, &[("\"distance\"", "\"sunOffset\"")]);
    fs::write(folder.join("bad.csv"), "1,2,3\n").unwrap();
    let negative = (0..6)
        .map(|row| (0..6).map(|column| if row == column { "-1" } else { "0" }).collect::<Vec<_>>().join(","));
    fs::write(folder.join("negative.csv"), negative.collect::<Vec<_>>().join("\n")).unwrap();
    let aim = "[flyby]\nbody = \"mercury\"\nbT = \"3500 km\"\nbR = 0\n";
    let cases = [
        (aim.replace("mercury", "venus"), ":4: flyby.body: found \"venus\", allowed: \"mercury\""),
        (
            aim.replace("3500 km", "2000 km"),
            ":5: flyby.bT: found B of 2000.0 and 0.0 km along T and R, whose periapsis lies",
        ),
        (
            aim.replace("bR = 0", "altitude = 1e5"),
            "flyby: found no whole aim, or two, allowed: either bT and bR, or altitude and angle",
        ),
        (format!("{aim}arrival = \"fixed\"\n"), "flyby.arrival: found fixed without time"),
        (
            "[flyby]\nbody = \"mercury\"\narrival = \"fixed\"\ntime = \"2008-10-06 UTC\"\n".to_owned(),
            "flyby.arrival: found fixed without an aim",
        ),
        (format!("every = \"1 s\"\n{aim}"), "every: found \"1 s\", allowed: a time from 1 min on"),
        (format!("{aim}from = \"2020-01-01 UTC\"\n"), ":7: flyby.from: found a time outside of the mission"),
        (format!("{aim}tolerance = 0\n"), ":7: flyby.tolerance: found 0, allowed: a length from 1 m on"),
        (
            format!("{aim}[update]\nat = \"2008-04-01 UTC\"\ncovariance = \"bad.csv\"\n"),
            "update.covariance: found ",
        ),
        (
            format!("{aim}[update]\nat = \"2008-04-01 UTC\"\ncovariance = \"negative.csv\"\n"),
            "allowed: a covariance, which is positive",
        ),
        (
            format!("{aim}[update]\nat = \"2007-04-01 UTC\"\n"),
            ":8: update.at: found a time outside of the mission",
        ),
        (
            format!("{aim}[compare]\nnext = \"2008-10-10 UTC\"\n"),
            ":8: compare.next: found a date before the departure manoeuvre",
        ),
        (
            format!("{aim}[compare]\nnext = \"2009-10-10 UTC\"\napproach = [\"-400 d\"]\n"),
            ":9: compare.approach[1]: found a time outside of the flight",
        ),
        (
            format!("{aim}from = \"2008-10-06T08:00:00 UTC\"\n"),
            ":7: flyby.from: found a time behind which no change moves the encounter",
        ),
        (
            format!("{aim}[compare]\nnext = \"2008-10-10 UTC\"\napproach = [\"42 d\"]\n"),
            "compare.approach[1]: found ",
        ),
        (format!("{aim}[montecarlo]\nruns = 1\n"), "montecarlo.runs: found 1, allowed: from 2 to 100000"),
    ];
    let file = folder.join("plan.toml");
    for (tables, expected) in cases {
        fs::write(&file, format!("mission = \"flyby.toml\"\nfreeze = 0\n{tables}")).unwrap();
        let printed = plan(&file, &folder.join("out"), &template, 2);
        says(&printed, &[expected]);
    }
}
