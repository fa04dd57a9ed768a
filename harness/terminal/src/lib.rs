//! Output on a terminal: text without control characters, tables, numbers, progress.

// They panic when the reader went away; `print` and `note` do not.
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod relay;

use std::{
    borrow::Cow,
    fmt,
    io::{self, Write},
};

use comfy_table::{ContentArrangement, TableComponent, presets};
use indicatif::ProgressStyle;

pub use indicatif::ProgressBar;
pub use relay::{Output, Relay, Screen, is_relayed, relay_to, screen, show_bar};

/// Prints a text; a reader that went away (as `head` does) is no error.
pub fn print(text: &str) -> io::Result<()> {
    let line = format!("{}\n", plain(&unsigned_zeros(text)));
    match Output.write_all(line.as_bytes()).and_then(|()| Output.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

/// Says something beside the output, on stderr; nobody there to read it is no error.
pub fn note(text: &str) {
    match relay::relay() {
        Some(relay) => relay.note(text),
        None => {
            let _ = writeln!(io::stderr().lock(), "{}", plain(&unsigned_zeros(text)));
        }
    }
}

/// The text with every control character but line break and tab written out, and those that turn the direction of
/// writing: a text of an FMU or a file moves no cursor and hides nothing.
pub fn plain(text: &str) -> Cow<'_, str> {
    let is_plain = |letter: char| match letter {
        '\n' | '\t' => true,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => false,
        // Line ends of their own.
        '\u{2028}' | '\u{2029}' => false,
        _ => !letter.is_control(),
    };
    if text.chars().all(is_plain) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if is_plain(letter) {
            shown.push(letter);
        } else {
            shown.extend(letter.escape_default());
        }
    }
    shown.into()
}

/// The text with every number that is zero as it is written, `-0` or `-0.000`, without its sign: nothing has no direction. What
/// follows a letter or a digit is no sign, as in names and dates.
pub fn unsigned_zeros(text: &str) -> Cow<'_, str> {
    let is_in_word =
        |letter: char| letter.is_alphanumeric() || matches!(letter, '.' | '_' | '-' | '+' | ')' | ']');
    let is_sign = |at: usize| {
        let number = text[at + 1..].split(|letter: char| !letter.is_alphanumeric() && letter != '.').next();
        let number = number.unwrap_or_default().trim_end_matches('.');
        number.starts_with('0')
            && number.parse() == Ok(0.0)
            && !text[..at].chars().next_back().is_some_and(is_in_word)
    };
    let signs: Vec<usize> = text.match_indices('-').map(|(at, _)| at).filter(|at| is_sign(*at)).collect();
    if signs.is_empty() {
        return text.into();
    }
    let mut unsigned = String::with_capacity(text.len());
    let mut from = 0;
    for at in signs {
        unsigned.push_str(&text[from..at]);
        from = at + 1;
    }
    (unsigned + &text[from..]).into()
}

/// A plain table.
pub struct Table(comfy_table::Table);

impl Table {
    /// Adds a row; zeros have no sign.
    pub fn add_row(&mut self, cells: impl IntoIterator<Item = impl AsRef<str>>) {
        self.0.add_row(cells.into_iter().map(|cell| unsigned_zeros(cell.as_ref()).into_owned()));
    }

    /// Columns one space apart.
    pub fn narrow(mut self) -> Self {
        self.0.column_iter_mut().for_each(|column| {
            column.set_padding((0, 0));
        });
        self
    }

    /// Whether it has no row but the header.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A plain table with a header; as wide as the terminal at most, unbounded elsewhere.
pub fn table(header: &[&str]) -> Table {
    let mut table = comfy_table::Table::new();
    table
        .load_preset(presets::UTF8_HORIZONTAL_ONLY)
        .remove_style(TableComponent::HorizontalLines)
        .remove_style(TableComponent::MiddleIntersections)
        .set_header(header);
    if let Some(columns) = screen().output_columns {
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(columns);
    }
    Table(table)
}

/// A bar on stderr over `count` of what `unit` names; hidden with `--quiet` and where stderr is no terminal.
pub fn progress(count: u64, unit: &str, is_quiet: bool) -> ProgressBar {
    let Some(columns) = screen().note_columns.filter(|_| !is_quiet) else { return ProgressBar::hidden() };
    let bar = match relay::relay() {
        Some(relay) => ProgressBar::with_draw_target(Some(count), relay::bar_target(relay, columns)),
        None => ProgressBar::new(count),
    };
    let template =
        format!("{{bar:40.cyan/blue}} {{percent:>3}}% of {{len}} {unit}, {{elapsed}} gone, {{eta}} to go");
    if let Ok(style) = ProgressStyle::with_template(&template) {
        bar.set_style(style);
    }
    bar
}

/// A number for people: six significant digits.
pub fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let magnitude = value.abs();
    if !(1e-4..1e7).contains(&magnitude) {
        let text = format!("{value:.5e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trim(digits));
    }
    let before = (magnitude.log10().floor() as i32).max(0);
    let digits = usize::try_from(5 - before).unwrap_or(0).max(if magnitude < 1.0 { 6 } else { 0 });
    trim(&format!("{value:.digits$}")).to_owned()
}

/// A number for people: four significant digits, what is lost in the rounding of larger numbers as 0.
pub fn rounded(value: f64) -> String {
    short(if value.abs() < 1e-9 { 0.0 } else { format!("{value:.3e}").parse().unwrap_or(value) })
}

/// Without the zeros behind the point.
fn trim(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_shown_without_control_characters() {
        assert!(matches!(plain("two\nlines\tλ 火星"), Cow::Borrowed(_)));
        assert_eq!(plain("\u{1b}[2Jok\r\u{7}"), "\\u{1b}[2Jok\\r\\u{7}");
        assert_eq!(plain("\u{9b}1m\u{202e}"), "\\u{9b}1m\\u{202e}");
        assert_eq!(plain("\0\u{7f}"), "\\u{0}\\u{7f}");
        assert_eq!(plain("a\u{200f}b\u{2028}c"), "a\\u{200f}b\\u{2028}c");
    }

    #[test]
    fn zeros_have_no_sign() {
        for (text, expected) in [
            ("-0", "0"),
            ("-0.000", "0.000"),
            ("-0.0e0,-0.00000e0", "0.0e0,0.00000e0"),
            ("X -0.00, Z -0.01 uN.m (-0.0).", "X 0.00, Z -0.01 uN.m (0.0)."),
            ("\"miss\": -0.0\n-0.", "\"miss\": 0.0\n0."),
        ] {
            assert_eq!(unsigned_zeros(text), expected);
        }
        for text in ["-0.0004", "-0x", "2009-04-06 1e-0", "a-0 --0 +-0 x[1]-0 -1.0 -", "-0.0.0"] {
            assert!(matches!(unsigned_zeros(text), Cow::Borrowed(_)), "{text}");
        }
        let mut table = table(&["value"]);
        table.add_row([format!("{:.3}, {:.1}", -0.000_4, -1.0)]);
        assert!(table.to_string().contains("0.000, -1.0") && !table.to_string().contains("-0"));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(short(0.1 + 0.2), "0.3");
        assert_eq!(short(7_776_000.0), "7776000");
        assert_eq!(short(-1.234_567_89e-7), "-1.23457e-7");
        assert_eq!(short(3.25e-4), "0.000325");
        assert_eq!(short(149_597_870_700.0), "1.49598e11");
    }
}
