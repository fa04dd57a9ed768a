//! The XML writer: UTF-8, two spaces a level, attributes left out where they equal their default.

use crate::Description;
use crate::document::{Sink, walk};

/// The `modelDescription.xml` of a description, in the order of the FMI 2.0.5 schema.
///
/// The same description gives the same bytes. Characters that XML 1.0 cannot carry, not even escaped (most
/// control characters), become U+FFFD.
pub fn to_xml(description: &Description) -> String {
    let mut sink = Xml { text: String::new(), open: Vec::new(), in_tag: false };
    sink.text.push_str("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    walk(description, &mut sink);
    sink.text
}

/// `text` as the content of a double-quoted attribute; tab and line breaks survive attribute normalisation.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    push_escaped(&mut out, text);
    out
}

/// Whether XML 1.0 can carry the character.
pub(crate) fn is_xml_char(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | '\u{20}'..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..)
}

fn push_escaped(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' => out.push_str("&#9;"),
            '\n' => out.push_str("&#10;"),
            '\r' => out.push_str("&#13;"),
            c if is_xml_char(c) => out.push(c),
            _ => out.push('\u{FFFD}'),
        }
    }
}

struct Xml {
    text: String,
    open: Vec<&'static str>,
    in_tag: bool,
}

impl Xml {
    fn indent(&mut self) {
        for _ in 0..self.open.len() {
            self.text.push_str("  ");
        }
    }
}

impl Sink for Xml {
    fn open(&mut self, element: &'static str) {
        if self.in_tag {
            self.text.push_str(">\n");
        }
        self.indent();
        self.text.push('<');
        self.text.push_str(element);
        self.open.push(element);
        self.in_tag = true;
    }

    fn attribute(&mut self, name: &'static str, text: &str) {
        self.text.push(' ');
        self.text.push_str(name);
        self.text.push_str("=\"");
        push_escaped(&mut self.text, text);
        self.text.push('"');
    }

    fn close(&mut self) {
        let Some(element) = self.open.pop() else { return };
        if self.in_tag {
            self.text.push_str("/>\n");
        } else {
            self.indent();
            self.text.push_str("</");
            self.text.push_str(element);
            self.text.push_str(">\n");
        }
        self.in_tag = false;
    }
}
