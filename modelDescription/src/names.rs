//! Names: the structured naming convention (2.2.9), C identifiers, elements of vectors, near misses.

use crate::ScalarVariable;

/// Whether `name` may be a `modelIdentifier`: letters, digits and `_`, not starting with a digit.
pub fn is_c_identifier(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes.next().is_some_and(is_nondigit) && bytes.all(|b| is_nondigit(b) || b.is_ascii_digit())
}

/// Checks a variable name against the grammar of `variableNamingConvention="structured"`:
///
/// ```text
/// name         = identifier | "der(" identifier [ "," unsigned ] ")"
/// identifier   = b-name [ indices ] { "." b-name [ indices ] }
/// b-name       = nondigit { digit | nondigit } | "'" q-char-or-escape { q-char-or-escape } "'"
/// indices      = "[" unsigned { "," unsigned } "]"
/// ```
///
/// The error names the character (1-based), what was found and what may stand there.
pub fn check_structured(name: &str) -> Result<(), String> {
    let mut scan = Scan { name, at: 0 };
    if name.starts_with("der(") {
        scan.at = "der(".len();
        scan.identifier()?;
        if scan.take(b',') {
            scan.unsigned()?;
        }
        if !scan.take(b')') {
            return Err(scan.error("`.`, `[`, `,` or `)`"));
        }
        return if scan.at == name.len() { Ok(()) } else { Err(scan.error("the end of the name")) };
    }
    scan.identifier()?;
    if scan.at == name.len() { Ok(()) } else { Err(scan.error("a letter, digit, `_`, `.` or `[`")) }
}

/// Checks a name of the flat convention: not empty, no carriage return, line feed or tab.
pub fn check_flat(name: &str) -> Result<(), String> {
    if name.is_empty() {
        return Err("is empty; a name needs at least one character".to_owned());
    }
    match name.chars().position(|c| matches!(c, '\r' | '\n' | '\t')) {
        Some(position) => {
            Err(format!("holds a line break or tab at character {}; these are not allowed", position + 1))
        }
        None => Ok(()),
    }
}

/// Splits the name of an element, `x[1,3]`, into that of its vector or matrix and the indices.
pub fn element(name: &str) -> Option<(&str, &str)> {
    name.strip_suffix(']')?.rsplit_once('[')
}

/// Whether a variable is an element of a matrix: `x[1,3]`.
pub fn is_of_matrix(name: &str) -> bool {
    element(name).is_some_and(|(_, indices)| indices.contains(','))
}

struct Scan<'a> {
    name: &'a str,
    at: usize,
}

impl Scan<'_> {
    fn peek(&self) -> Option<u8> {
        self.name.as_bytes().get(self.at).copied()
    }

    fn take(&mut self, expected: u8) -> bool {
        let found = self.peek() == Some(expected);
        self.at += usize::from(found);
        found
    }

    fn skip_while(&mut self, allowed: impl Fn(u8) -> bool) -> bool {
        let start = self.at;
        while self.peek().is_some_and(&allowed) {
            self.at += 1;
        }
        self.at > start
    }

    fn identifier(&mut self) -> Result<(), String> {
        loop {
            self.b_name()?;
            if self.take(b'[') {
                self.indices()?;
            }
            if !self.take(b'.') {
                return Ok(());
            }
        }
    }

    fn b_name(&mut self) -> Result<(), String> {
        if self.take(b'\'') {
            return self.quoted();
        }
        if !self.peek().is_some_and(is_nondigit) {
            return Err(self.error("a letter, `_` or `'`"));
        }
        self.skip_while(|b| is_nondigit(b) || b.is_ascii_digit());
        Ok(())
    }

    fn quoted(&mut self) -> Result<(), String> {
        let start = self.at;
        loop {
            if self.skip_while(is_q_char) {
                continue;
            }
            if self.take(b'\\') {
                if !self.peek().is_some_and(|b| b"'\"?\\abfnrtv".contains(&b)) {
                    return Err(self.error("one of ' \" ? \\ a b f n r t v after the backslash"));
                }
                self.at += 1;
                continue;
            }
            if self.at == start || !self.take(b'\'') {
                return Err(self.error("a printable ASCII character or the closing `'`"));
            }
            return Ok(());
        }
    }

    fn indices(&mut self) -> Result<(), String> {
        loop {
            self.unsigned()?;
            if self.take(b']') {
                return Ok(());
            }
            if !self.take(b',') {
                return Err(self.error("a digit, `,` or `]`"));
            }
        }
    }

    fn unsigned(&mut self) -> Result<(), String> {
        if self.skip_while(|b| b.is_ascii_digit()) { Ok(()) } else { Err(self.error("a digit")) }
    }

    fn error(&self, allowed: &str) -> String {
        // Everything taken is ASCII, so `at` is a character boundary and counts characters.
        match self.name.get(self.at..).and_then(|rest| rest.chars().next()) {
            Some(found) => format!("has {found:?} at character {}; allowed is {allowed}", self.at + 1),
            None => format!("ends after {} characters; allowed is {allowed}", self.at),
        }
    }
}

fn is_nondigit(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

fn is_q_char(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_!#$%&()*+,-./:;<>=?@[]^{}|~ ".contains(&byte)
}

/// Positions of the elements of a vector or matrix under its bare name, in declaration order: `x` means `x[1]`,
/// `x[2]`, … or `x[1,1]`, `x[1,2]`, …
pub fn elements(variables: &[ScalarVariable], name: &str) -> Vec<usize> {
    let is_index = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_element = |candidate: &str| {
        let rest = candidate.strip_prefix(name).and_then(|rest| rest.strip_prefix('['));
        rest.and_then(|rest| rest.strip_suffix(']')).is_some_and(|indices| indices.split(',').all(is_index))
    };
    let all = variables.iter().enumerate();
    all.filter(|(_, variable)| is_element(&variable.name)).map(|(index, _)| index).collect()
}

/// The names closest to `name`, best first.
pub fn similar<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let expected = name.to_lowercase();
    let mut ranked: Vec<(usize, &str)> = names
        .map(|candidate| {
            let lower = candidate.to_lowercase();
            let contained = lower.contains(&expected) || expected.contains(&lower);
            (if contained { 1 } else { strsim::levenshtein(&expected, &lower) }, candidate)
        })
        .filter(|(distance, _)| *distance <= 2 + name.len() / 5 && *distance < name.len().max(2))
        .collect();
    ranked.sort();
    ranked.into_iter().take(3).map(|(_, candidate)| candidate).collect()
}

/// Asks for the name closest to `name` that may have been meant; empty where none is near.
pub fn hint<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> String {
    let near = similar(name, names);
    near.first().map(|near| format!(" (did you mean {near:?}?)")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_pen_is_recognised() {
        let names = ["spacecraft.mass", "solar.flux", "dump.count"];
        assert_eq!(similar("spacecraft.maas", names.into_iter()), ["spacecraft.mass"]);
        assert_eq!(similar("flux", names.into_iter()), ["solar.flux"]);
        assert!(similar("nothing.like.it", names.into_iter()).is_empty());
    }

    #[test]
    fn a_bare_name_means_the_elements_of_one_vector_or_matrix() {
        let named = |name: &str| ScalarVariable { name: name.to_owned(), ..ScalarVariable::default() };
        let all =
            ["a[1]", "a[2]", "a.b", "ab[1]", "m[1,1]", "m[1,2]", "wheel[1].axis[1]", "wheel[1].axis[2]"]
                .map(named);
        assert_eq!(elements(&all, "a"), [0, 1]);
        assert_eq!(elements(&all, "m"), [4, 5]);
        assert_eq!(elements(&all, "wheel[1].axis"), [6, 7]);
        for none in ["wheel", "a.b", "a[1]", "b", ""] {
            assert!(elements(&all, none).is_empty(), "{none}");
        }
    }
}
