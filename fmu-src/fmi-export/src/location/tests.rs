//! Every way importers write a location leads to the folder they mean.
use super::*;

fn first(location: &str, windows: bool) -> String {
    paths(location.as_bytes(), windows).unwrap()[0].to_str().unwrap().to_owned()
}

#[test]
fn the_forms_of_a_file_uri() {
    for location in ["file:///a/b", "file:/a/b", "file://localhost/a/b", "FILE:///a/b", "/a/b"] {
        assert_eq!(first(location, false), "/a/b", "{location}");
    }
    assert_eq!(first("file:///a%20b/%C3%BC%2B+%7Bx%7D/100%/%zz", false), "/a b/ü++{x}/100%/%zz");
}

#[test]
fn windows_drives_and_shares() {
    for location in ["file:///C:/a%20b", "file:/C:/a%20b", "file://C:/a%20b", "C:/a b"] {
        assert_eq!(first(location, true), "C:/a b", "{location}");
    }
    assert_eq!(first("file://LOCALHOST/c:/%E7%81%AB", true), "c:/火");
    for location in ["file://server/my%20share/x", "file:////server/my%20share/x", "//server/my share/x"] {
        assert_eq!(first(location, true), "//server/my share/x", "{location}");
    }
    for location in ["\\\\server\\share", "\\\\?\\C:\\a b", "C:\\a b"] {
        assert_eq!(first(location, true), location);
    }
}

#[test]
fn other_schemes_hosts_and_nul_are_refused() {
    for (location, word) in [
        ("http://a/b", "no file URI"),
        ("file://server/share", "`server`"),
        ("fil", "no file URI"),
        ("file:///a%00b", "NUL"),
    ] {
        let error = paths(location.as_bytes(), false).unwrap_err();
        assert!(error.contains(word) && error.contains(location), "{error}");
    }
}

#[test]
fn a_folder_is_found_under_any_encoding_of_its_name() {
    let base = std::env::temp_dir().join(format!("fmi-export-location-{}", std::process::id()));
    for (name, forms) in [
        ("a b+c{d}", ["a%20b+c%7Bd%7D", "a b+c{d}", "a%2520b+c%257Bd%257D"]),
        ("50%25ü", ["50%2525%C3%BC", "50%25ü", "50%252525%25C3%25BC"]),
    ] {
        let folder = base.join(name);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("setup.toml"), name).unwrap();
        for form in forms {
            let location = format!("file://{}/{form}", base.to_str().unwrap());
            let found = resolve(location.as_bytes()).unwrap();
            assert_eq!(found, Some(folder.clone()), "{location}");
            assert_eq!(read(&folder, "setup.toml").unwrap(), name);
        }
    }
    assert_eq!(resolve(b"").unwrap(), None);
    let missing = resolve(b"file:///no/such/folder").unwrap_err();
    assert!(missing.contains("`/no/such/folder`") && missing.contains("does not exist"), "{missing}");
    let unread = read(&base, "other.toml").unwrap_err();
    assert!(unread.contains("other.toml"), "{unread}");
    std::fs::remove_dir_all(&base).unwrap();
}

/// Opening a pipe would wait for ever.
#[test]
#[cfg(unix)]
fn what_is_no_regular_file_is_refused_by_name() {
    let folder = std::env::temp_dir().join(format!("fmi-export-pipe-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("a-folder")).unwrap();
    let pipe = folder.join("a-pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    for name in ["a-folder", "a-pipe"] {
        if name == "a-pipe" && !made.as_ref().is_ok_and(std::process::ExitStatus::success) {
            continue;
        }
        let refused = read(&folder, name).unwrap_err();
        assert!(refused.contains(name) && refused.contains("no regular file"), "{refused}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
