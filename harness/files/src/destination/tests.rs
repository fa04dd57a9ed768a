//! Content changes only when it is replaced whole, and nothing else stays behind.

use super::*;

fn open(path: &Path) -> Result<Destination, String> {
    Destination::open(path, "--output", &[])
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn an_unused_destination_leaves_no_trace() {
    let scratch = tempfile::tempdir().unwrap();
    let (new, old) = (scratch.path().join("new"), scratch.path().join("old"));
    fs::write(&old, "precious").unwrap();
    for path in [&new, &old] {
        drop(open(path).unwrap());
        drop(open(path).unwrap().grow(&[]).unwrap());
    }
    assert_eq!(names(scratch.path()), ["old"]);
    assert_eq!(fs::read_to_string(&old).unwrap(), "precious");
}

#[test]
fn a_filled_destination_holds_the_new_content_only() {
    let scratch = tempfile::tempdir().unwrap();
    let (new, old) = (scratch.path().join("new"), scratch.path().join("old"));
    fs::write(&old, "precious").unwrap();
    for path in [&new, &old] {
        open(path).unwrap().fill(|file| file.write_all(b"ours")).unwrap();
        assert_eq!(fs::read_to_string(path).unwrap(), "ours");
    }
    assert_eq!(names(scratch.path()), ["new", "old"]);
}

#[test]
fn content_that_cannot_be_completed_changes_nothing() {
    let scratch = tempfile::tempdir().unwrap();
    let old = scratch.path().join("old");
    fs::write(&old, "precious").unwrap();
    let message = open(&old).unwrap().fill(|file| {
        file.write_all(b"damaged")?;
        Err(io::Error::other("the disk is full"))
    });
    assert!(message.unwrap_err().ends_with("old: the disk is full: see --output"));
    assert_eq!(fs::read_to_string(&old).unwrap(), "precious");
    assert_eq!(names(scratch.path()), ["old"]);
}

#[test]
fn a_recording_grows_as_part_until_it_is_complete() {
    let scratch = tempfile::tempdir().unwrap();
    let (path, part) = (scratch.path().join("a.csv"), scratch.path().join("a.csv.part"));
    fs::write(&path, "old").unwrap();
    let mut growing = open(&path).unwrap().grow(&[]).unwrap();
    growing.append(b"1\n").unwrap();
    assert_eq!((fs::read(&path).unwrap(), fs::read(&part).unwrap()), (b"old".to_vec(), b"1\n".to_vec()));
    growing.append(b"2\n").unwrap();
    growing.finish().unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"1\n2\n");
    assert_eq!(names(scratch.path()), ["a.csv"]);

    let mut growing = open(&path).unwrap().grow(&[]).unwrap();
    growing.append(b"3\n").unwrap();
    assert_eq!(growing.leave().as_deref(), Some(part.as_path()));
    assert_eq!((fs::read(&path).unwrap(), fs::read(&part).unwrap()), (b"1\n2\n".to_vec(), b"3\n".to_vec()));
    // Nobody else writes it meanwhile, and when it is not written any more, anybody may.
    let mut growing = open(&path).unwrap().grow(&[]).unwrap();
    for _ in 0..2 {
        let message = open(&path).unwrap().grow(&[]).unwrap_err();
        assert!(message.ends_with("a.csv.part: another run is writing it: see --output"), "{message}");
        growing.append(b"4\n").unwrap();
    }
    growing.finish().unwrap();
    assert_eq!((fs::read(&path).unwrap(), part.exists()), (b"4\n4\n".to_vec(), false));
    let mut growing = open(&path).unwrap().grow(&[]).unwrap();
    growing.append(b"5\n").unwrap();
    drop(growing);
    assert_eq!(fs::read(&part).unwrap(), b"5\n");
    // What is in the way of the recording is an input: it is kept.
    let message = open(&path).unwrap().grow(&[&part]).unwrap_err();
    assert!(message.contains("an input too"), "{message}");
}

#[test]
fn what_cannot_be_written_is_reported_with_its_option() {
    let scratch = tempfile::tempdir().unwrap();
    let message = |path: &Path| Destination::open(path, "--plot", &[]).err().unwrap();
    let folder = message(&scratch.path().join("no/such/a.svg"));
    assert!(folder.contains("there is no folder") && folder.ends_with("see --plot"), "{folder}");
    let folder = message(scratch.path());
    assert!(folder.contains("found a directory") && folder.ends_with("see --plot"), "{folder}");
}

#[cfg(unix)]
#[test]
fn a_part_that_is_another_file_too_is_left_alone() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    fs::write(at("precious"), "precious").unwrap();
    fs::hard_link(at("precious"), at("a.csv.part")).unwrap();
    let mut growing = open(&at("a.csv")).unwrap().grow(&[]).unwrap();
    growing.append(b"1\n").unwrap();
    growing.finish().unwrap();
    assert_eq!(fs::read(at("a.csv")).unwrap(), b"1\n");
    std::os::unix::fs::symlink("precious", at("a.csv.part")).unwrap();
    let message = open(&at("a.csv")).unwrap().grow(&[]).unwrap_err();
    assert!(message.contains("a.csv.part: found "), "{message}");
    assert_eq!(fs::read(at("precious")).unwrap(), b"precious");
}

#[cfg(unix)]
#[test]
fn a_file_is_within_a_folder_behind_all_links() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    for name in ["home/deep", "away"] {
        fs::create_dir_all(at(name)).unwrap();
    }
    fs::write(at("away/old"), "x").unwrap();
    std::os::unix::fs::symlink(at("away"), at("home/link")).unwrap();
    std::os::unix::fs::symlink(at("away/old"), at("home/old")).unwrap();
    for (name, expected) in [
        ("home/new", true),
        ("home/deep/new", true),
        ("home/deep/../new", true),
        ("home/link/new", false),
        ("home/old", false),
        ("away/new", false),
    ] {
        assert_eq!(open(&at(name)).unwrap().is_within(&at("home")), expected, "{name}");
    }
    assert!(open(Path::new("/dev/stdout")).unwrap().is_stdout());
}

#[cfg(unix)]
#[test]
fn an_input_is_no_target_under_any_name() {
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    fs::write(at("input"), "precious").unwrap();
    fs::hard_link(at("input"), at("hard")).unwrap();
    std::os::unix::fs::symlink(at("input"), at("soft")).unwrap();
    std::os::unix::fs::symlink("soft", at("softer")).unwrap();
    fs::create_dir(at("folder")).unwrap();
    for name in ["input", "folder/../input", "hard", "soft", "softer"] {
        let message = Destination::open(&at(name), "--output", &[&at("input")]).unwrap_err();
        assert!(message.contains("it is an input too") && message.ends_with("see --output"), "{message}");
    }
    for name in ["folder/new", "folder/../folder/new"] {
        let message = Destination::open(&at(name), "--output", &[&at("folder")]).unwrap_err();
        assert!(message.contains("it is an input too"), "{message}");
    }
    let (one, two) = (open(&at("new")).unwrap(), open(&at("folder/../new")).unwrap());
    assert!(one.is_same(&two) && !one.is_same(&open(&at("other")).unwrap()));
}

#[cfg(unix)]
#[test]
fn links_and_permissions_are_kept_and_devices_refused() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    fs::write(at("old"), "old").unwrap();
    fs::set_permissions(at("old"), fs::Permissions::from_mode(0o640)).unwrap();
    std::os::unix::fs::symlink("old", at("link")).unwrap();
    std::os::unix::fs::symlink("new", at("dangling")).unwrap();
    for (link, target) in [("link", "old"), ("dangling", "new")] {
        open(&at(link)).unwrap().fill(|file| file.write_all(b"ours")).unwrap();
        assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink());
        assert_eq!(fs::read(at(target)).unwrap(), b"ours");
    }
    assert_eq!(fs::metadata(at("old")).unwrap().permissions().mode() & 0o777, 0o640);
    let message = open(Path::new("/dev/null")).unwrap_err();
    assert!(message.contains("found a character device, allowed: a regular file or -"), "{message}");
}
