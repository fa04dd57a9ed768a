//! Typical mistakes in files that people write: what `check` says of each, or the command that finds it, is recorded, to be read.

use std::{fs, path::Path};

use crate::{heliotorque, legs::flyby, momentum_plans::cruise, run, shown, template, text, words};

const RECORDED: &str = "tests/main/mistakes.txt";
/// What begins a line of what is said.
const PRINTED: &str = "    ";

/// A mistake in a base file.
#[derive(Default)]
struct Mistake {
    kind: String,
    /// Lines of the base, and what stands in their place.
    edits: Vec<(Vec<String>, Vec<String>)>,
    bytes: Option<String>,
    /// What reads it, where `check` does not.
    command: Option<String>,
}

/// Momentum that a refit is to fit.
const TELEMETRY: &str = "time,momentum.inertial[1],momentum.inertial[2],momentum.inertial[3]\n0,0,0,0\n86400,0.1,0,0\n\
                         172800,0.2,0,0.1\n259200,0.3,0.1,0.1\n";

/// A table that is drawn, or compared with the same one beside it.
const TABLE: &str =
    "time,momentum.body[1],momentum.body[2],mode\n0,1,0,nadir\n60,2,0.5,nadir\n120,4,1,safe\n";

fn parse(block: &str) -> Mistake {
    let mut mistake = Mistake::default();
    for line in block.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            mistake.kind = heading.split_once(':').unwrap().0.to_owned();
        } else if let Some(old) = line.strip_prefix("- ") {
            match mistake.edits.last_mut() {
                Some((olds, news)) if news.is_empty() => olds.push(old.to_owned()),
                _ => mistake.edits.push((vec![old.to_owned()], Vec::new())),
            }
        } else if let Some(new) = line.strip_prefix("+ ") {
            match mistake.edits.last_mut() {
                Some((_, news)) => news.push(new.to_owned()),
                None => mistake.edits.push((Vec::new(), vec![new.to_owned()])),
            }
        } else if let Some(bytes) = line.strip_prefix("@ ") {
            mistake.bytes = Some(bytes.to_owned());
        } else if let Some(command) = line.strip_prefix("$ ") {
            mistake.command = Some(command.to_owned());
        }
    }
    mistake
}

impl Mistake {
    /// Name of the file, beside which stand those that its command needs, in a folder, and what stands in it.
    fn base(&self, folder: &Path) -> (String, String) {
        let toml = format!("{}.toml", self.kind);
        if ["leg", "flyby"].contains(&self.kind.as_str()) {
            flyby(folder, 1, &[]);
            let text = fs::read_to_string(folder.join(&toml)).unwrap();
            return (toml, text);
        }
        if self.kind == "campaign" {
            run(&["new", "mission", shown(&folder.join("mission.toml")), "--force"], 0);
        }
        if self.kind == "table" {
            fs::write(folder.join("other.csv"), TABLE).unwrap();
            return ("table.csv".to_owned(), TABLE.to_owned());
        }
        if self.command.is_none() && self.kind != "plan" {
            return (toml, run(&["new", &self.kind, "-"], 0));
        }
        cruise(folder, &[("stop = \"200 d\"", "stop = \"40 d\"")]);
        let plan = run(&["new", "plan", "-"], 0)
            .replace("mission = \"plan-mission.toml\"     ", "mission = \"cruise.toml\"          ");
        for (name, text) in [("plan.toml", plan.as_str()), ("telemetry.csv", TELEMETRY)] {
            fs::write(folder.join(name), text).unwrap();
        }
        let name = if self.kind == "telemetry" { "telemetry.csv".to_owned() } else { toml };
        let text = fs::read_to_string(folder.join(&name)).unwrap();
        (name, text)
    }

    /// The file with the mistake.
    fn text(&self, base: &str) -> String {
        let mut text = base.to_owned();
        for (olds, news) in &self.edits {
            let joined = |lines: &[String]| lines.iter().map(|line| format!("{line}\n")).collect::<String>();
            if olds.is_empty() {
                text.push_str(&joined(news));
                continue;
            }
            let whole = joined(olds);
            if text.contains(&whole) {
                text = text.replacen(&whole, &joined(news), 1);
                continue;
            }
            // Lines that stand apart.
            assert!(news.is_empty(), "{whole} is not in the base");
            for old in olds {
                let line = format!("{old}\n");
                assert!(text.contains(&line), "{line} is not in the base");
                text = text.replacen(&line, "", 1);
            }
        }
        text
    }

    fn write(&self, base: &str, path: &Path) {
        let text = self.text(base);
        let _ = fs::remove_dir(path);
        let bytes = match self.bytes.as_deref() {
            None => text.into_bytes(),
            Some("byte order mark") => format!("\u{feff}{text}").into_bytes(),
            Some("carriage returns") => text.replace('\n', "\r\n").into_bytes(),
            Some("UTF-16") => {
                let units = std::iter::once(0xfeff).chain(text.encode_utf16());
                units.flat_map(u16::to_le_bytes).collect()
            }
            Some("Latin-1") => text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect(),
            Some("empty") => Vec::new(),
            Some("comments") => {
                text.lines().map(|line| format!("# {line}\n")).collect::<String>().into_bytes()
            }
            Some("binary") => text.replace(' ', "\0").into_bytes(),
            Some("ZIP archive") => [b"PK\x03\x04", text.as_bytes()].concat(),
            Some("folder") => {
                let _ = fs::remove_file(path);
                return fs::create_dir(path).unwrap();
            }
            Some("absent") => return drop(fs::remove_file(path)),
            Some(other) => panic!("@ {other}"),
        };
        fs::write(path, bytes).unwrap();
    }
}

#[test]
fn every_typical_mistake_is_reported_with_file_place_finding_and_remedy() {
    let Some((scratch, _)) = template() else { return };
    let wrong = run(&["new", "spacecraft", "-"], 0).replace("mass_kg = 400.0", "mass_kg = -4.0");
    fs::write(scratch.path().join("wrong.toml"), wrong).unwrap();
    let refit = "{\"spacecraft\": \"Other\", \"centerOfMass_m\": [0, 0, 0], \"scale\": 1, \"covariance\": \
                 [[1e-8,0,0,0],[0,1e-8,0,0],[0,0,1e-8,0],[0,0,0,1e-4]]}";
    fs::write(scratch.path().join("other.json"), refit).unwrap();

    let recorded = fs::read_to_string(RECORDED).unwrap();
    let mut found = String::new();
    let mut reported = 0;
    for (k, block) in recorded.split("\n## ").enumerate() {
        if k == 0 {
            found.push_str(block);
            continue;
        }
        let block = format!("## {block}");
        let mistake = parse(&block);
        let (name, base) = mistake.base(scratch.path());
        mistake.write(&base, &scratch.path().join(&name));
        let command = mistake.command.unwrap_or_else(|| format!("check {name}"));
        let no_template = ["compare", "plot"].iter().any(|it| command.starts_with(it));
        let template = if no_template { Vec::new() } else { vec!["--template", "template.fmu"] };
        let command = [words(&command), template].concat();
        let output = heliotorque(&command).current_dir(scratch.path()).output().unwrap();
        let printed = text(&output);
        let is_refused = matches!(output.status.code(), Some(1 | 2));
        if is_refused {
            reported += 1;
            let names = [".toml", &name, " for '--"];
            assert!(names.iter().any(|it| printed.contains(it)), "{block}\n{printed}");
            assert!(!printed.contains(shown(scratch.path())), "{printed}");
        }
        let input = block.lines().filter(|line| !line.starts_with(PRINTED) && !line.is_empty());
        found.push('\n');
        input.for_each(|line| found.push_str(&format!("{line}\n")));
        // What a file that is taken comes to is reported elsewhere.
        let printed = printed.lines().enumerate();
        let printed = printed.filter(|(k, line)| is_refused || *k == 0 || line.starts_with("warning"));
        printed.for_each(|(_, line)| found.push_str(&format!("{}\n", format!("{PRINTED}{line}").trim_end())));
    }
    if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
        fs::write(RECORDED, &found).unwrap();
    }
    assert!(reported >= 50, "{reported} mistakes");
    assert!(found == fs::read_to_string(RECORDED).unwrap(), "what is said has changed: {found}");
}

/// Whatever is expected, a file of another kind is named with what is done with it.
#[test]
fn every_command_says_what_the_wrong_file_is() {
    let scratch = tempfile::tempdir().unwrap();
    for kind in ["spacecraft", "spinner", "mission", "timeline"] {
        let file = scratch.path().join(format!("{kind}.toml"));
        run(&["new", kind, shown(&file)], 0);
    }
    fs::write(scratch.path().join("empty.toml"), "").unwrap();
    fs::write(scratch.path().join("bytes.toml"), "a\0b").unwrap();
    fs::write(scratch.path().join("of-file.toml"), "fmu = \"spacecraft.toml\"\nstop = 1\n").unwrap();
    let a_mission = "found a mission, allowed: a spacecraft: run it: `heliotorque run mission.toml`";
    let a_spacecraft = "`heliotorque pack spacecraft.toml` makes an FMU of it";
    for (line, printed) in [
        ("plan spin --spacecraft mission.toml", a_mission),
        ("plan spin --spacecraft spacecraft.toml", "found a three-axis spacecraft, allowed: a spinner"),
        ("run spacecraft.toml", a_spacecraft),
        (
            "run timeline.toml",
            "found a timeline, allowed: a mission: `timeline = \"timeline.toml\"` in a mission",
        ),
        ("run of-file.toml", a_spacecraft),
        (
            "run empty.toml",
            "empty.toml: found an empty file, allowed: a mission: see `heliotorque new mission`",
        ),
        ("run bytes.toml", "bytes.toml: found a binary file, allowed: a text saved as UTF-8"),
        ("info spacecraft.toml", a_spacecraft),
        (
            "info mission.toml",
            "found a mission, allowed: an FMU or a system: run it: `heliotorque run mission.toml`",
        ),
        ("wire spacecraft.toml --output x.ssp", a_spacecraft),
        ("check empty.toml", "empty.toml: found an empty file, allowed: a spacecraft, a spinner, a mission"),
        ("pack --mission spacecraft.toml", a_spacecraft),
    ] {
        let output = heliotorque(&crate::words(line)).current_dir(scratch.path()).output().unwrap();
        let found = text(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {found}");
        assert!(found.contains(printed), "{line}: {found}");
    }
    let Some((packed, _)) = template() else { return };
    let template = packed.path().join("template.fmu");
    for (line, printed) in [
        ("pack --spacecraft mission.toml", a_mission),
        ("pack --model Guidance --timeline mission.toml", "found a mission, allowed: a timeline: run it"),
        ("pack --ephemeris timeline.toml", "found a timeline, allowed: an ephemeris: "),
        ("map mission.toml", a_mission),
    ] {
        let line = format!("{line} --template {}", shown(&template));
        let output = heliotorque(&crate::words(&line)).current_dir(scratch.path()).output().unwrap();
        let found = text(&output);
        assert!(output.status.code() == Some(2) && found.contains(printed), "{line}: {found}");
    }
}
