//! Mistakes on the command line: status 2 where arguments, a file or an FMU are wrong, 1 where the answer is no.

use std::fs;

use crate::{heliotorque, says, template, text};

/// Arguments, the exit status, and words of the message; files stand in the folder of the test.
const MISTAKES: [(&str, i32, &[&str]); 48] = [
    // Usage.
    ("", 2, &["Usage", "Any FMU", "Your spacecraft", "Plans"]),
    ("runn x.fmu", 2, &["'run'"]),
    ("run", 2, &["<FMU>"]),
    ("run template.fmu --stop soon", 2, &["--stop", "10min"]),
    ("run template.fmu --step -5", 2, &["--step"]),
    ("run template.fmu --nonsense", 2, &["--nonsense"]),
    ("run template.fmu --tolerance 0", 2, &["--tolerance", "above 0"]),
    ("run template.fmu --log-calls -", 2, &["--log-calls", "allowed: a file"]),
    ("run template.fmu -o a.png", 2, &["a.png: found another ending, allowed: .csv, .svg, or -"]),
    ("run template.fmu -o a.csv -o b.csv", 2, &["b.csv: found two files of .csv"]),
    ("sweep campaign.toml -o a.txt", 2, &["a.txt: found another ending, allowed: .csv"]),
    ("map craft.toml -o a.pdf", 2, &["a.pdf: found another ending, allowed: .csv, .svg"]),
    ("map craft.toml --step 1", 2, &["--step", "an angle carries its unit"]),
    ("draw", 2, &["<SPACECRAFT>"]),
    ("draw craft.toml --angle 3", 2, &["an angle carries its unit"]),
    ("new", 2, &["<KIND>"]),
    ("new --schema nothing", 2, &["spacecraft", "campaign"]),
    ("plan spin --angle 2", 2, &["--angle", "2deg"]),
    ("plan spin --from 251.5,-21.5", 2, &["--from", "83.63deg,22.01deg"]),
    ("plan spin --rate 5", 2, &["--rate", "5rpm"]),
    ("plan leg.toml --output out --seeds 3", 2, &["found a leg", "--seeds"]),
    // Earlier forms.
    ("schema mission", 2, &["heliotorque new --schema KIND"]),
    ("plan momentum plan.toml --output out", 2, &["heliotorque plan FILE"]),
    ("plan flyby plan.toml --output out", 2, &["heliotorque plan FILE"]),
    ("plan leg leg.toml --output out", 2, &["heliotorque plan FILE"]),
    ("plan spin --rate-rpm 5", 2, &["heliotorque plan spin --rate 5rpm"]),
    ("plan spin --fmu x.fmu", 2, &["heliotorque plan spin --template FMU"]),
    ("run template.fmu --plot a.svg", 2, &["heliotorque run FMU --output FILE.svg"]),
    ("compare a.csv b.csv --plot=d.svg", 2, &["--output FILE.svg"]),
    ("map craft.toml --csv a.csv", 2, &["--output FILE.csv"]),
    ("map craft.toml --mission a.csv", 2, &["--recording CSV"]),
    ("check template.fmu --only locale", 2, &["--probe TEXT"]),
    ("ephemeris template.fmu --start A --stop B", 2, &["--template FMU"]),
    // Files.
    ("info missing.fmu", 2, &["missing.fmu"]),
    ("run missing.fmu", 2, &["missing.fmu"]),
    ("check missing.fmu", 2, &["missing.fmu"]),
    ("check missing.toml", 2, &["missing.toml"]),
    ("compare a.csv missing.csv", 2, &["missing.csv"]),
    ("plot missing.csv", 2, &["missing.csv"]),
    ("pack craft.toml --spacecraft craft.toml", 2, &["craft.toml: found it beside --spacecraft"]),
    ("plan craft.toml --output out", 2, &["craft.toml: found a spacecraft, allowed: a plan"]),
    ("map spinner.toml --template template.fmu", 2, &["found a spinner"]),
    // FMUs and values.
    ("run template.fmu --set nope=1", 2, &["nope"]),
    ("run template.fmu --set orbit.trueAnomaly=220.5", 2, &["allowed: 220.5 deg or 220.5 rad"]),
    ("ephemeris --start foo --stop 2011-05-06TDB", 2, &["--start", "foo"]),
    // The answer is no.
    ("compare a.csv b.csv", 1, &["1 of 1 beyond"]),
    ("check broken.toml --template template.fmu", 1, &["broken.toml", "1 problem"]),
    ("plan spin --angle 2deg --max-nutation 0.001deg", 1, &["no plan keeps the limits"]),
];

#[test]
fn every_mistake_has_its_status_and_names_what_is_wrong() {
    let Some((scratch, _)) = template() else { return };
    let folder = scratch.path();
    let program = |arguments: &[&str]| heliotorque(arguments).current_dir(folder).output().unwrap();
    for (kind, file) in [
        ("spacecraft", "craft.toml"),
        ("spinner", "spinner.toml"),
        ("leg", "leg.toml"),
        ("campaign", "campaign.toml"),
    ] {
        assert!(program(&["new", kind, file]).status.success(), "{kind}");
    }
    let broken = fs::read_to_string(folder.join("craft.toml")).unwrap();
    fs::write(folder.join("broken.toml"), broken.replace("mass_kg = 400.0", "mass_kg = -4.0")).unwrap();
    fs::write(folder.join("a.csv"), "time,x\n0,1\n1,2\n").unwrap();
    fs::write(folder.join("b.csv"), "time,x\n0,1\n1,3\n").unwrap();
    for (line, status, words) in MISTAKES {
        let arguments: Vec<&str> = line.split(' ').filter(|word| !word.is_empty()).collect();
        let output = program(&arguments);
        let printed = text(&output);
        assert_eq!(output.status.code(), Some(status), "{line}: {printed}");
        says(&printed, words);
        assert!(!printed.contains("-in-child") && !printed.contains("assemble"), "{line}: {printed}");
    }
}

#[test]
fn every_page_of_the_manual_lists_the_statuses() {
    for page in
        ["info", "check", "run", "wire", "sweep", "compare", "plot", "new", "draw", "map", "size", "pack"]
            .into_iter()
            .chain(["ephemeris", "plan", "plan-spin", "refit"])
    {
        let printed = text(&heliotorque(&["man", page]).output().unwrap());
        says(
            &printed,
            &[".SH \"EXIT STATUS\"", "\\fB1\\fR\nthe answer is no", "\\fB2\\fR\ntrouble with arguments"],
        );
    }
}
