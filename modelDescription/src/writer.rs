//! Elements and attributes as XML text: UTF-8, two spaces a level.

use crate::lexical::Lexical;

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

/// The document so far.
#[derive(Default)]
pub(crate) struct Writer {
    pub(crate) text: String,
    open: Vec<&'static str>,
    in_tag: bool,
    pub(crate) illegal: Vec<(&'static str, &'static str, char)>,
}

impl Writer {
    fn indent(&mut self) {
        for _ in 0..self.open.len() {
            self.text.push_str("  ");
        }
    }

    pub(crate) fn element(&mut self, name: &'static str, content: impl FnOnce(&mut Self)) {
        if self.in_tag {
            self.text.push_str(">\n");
        }
        self.indent();
        self.text.push('<');
        self.text.push_str(name);
        self.open.push(name);
        self.in_tag = true;
        content(self);
        self.open.pop();
        if self.in_tag {
            self.text.push_str("/>\n");
        } else {
            self.indent();
            self.text.push_str("</");
            self.text.push_str(name);
            self.text.push_str(">\n");
        }
        self.in_tag = false;
    }

    /// An attribute of the element last opened, before its content.
    pub(crate) fn attribute(&mut self, name: &'static str, value: &impl Lexical) {
        let text = value.text();
        if let Some(c) = text.chars().find(|c| !is_xml_char(*c)) {
            self.illegal.push((self.open.last().copied().unwrap_or_default(), name, c));
        }
        self.text.push(' ');
        self.text.push_str(name);
        self.text.push_str("=\"");
        push_escaped(&mut self.text, &text);
        self.text.push('"');
    }

    /// An attribute that may be left out.
    pub(crate) fn optional(&mut self, name: &'static str, value: &Option<impl Lexical>) {
        value.iter().for_each(|value| self.attribute(name, value));
    }

    pub(crate) fn list<T>(&mut self, name: &'static str, items: &[T], mut item: impl FnMut(&mut Self, &T)) {
        if !items.is_empty() {
            self.element(name, |out| items.iter().for_each(|value| item(out, value)));
        }
    }
}
