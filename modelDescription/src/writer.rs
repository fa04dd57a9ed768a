//! Elements and attributes as XML text: UTF-8, two spaces a level.

use std::{borrow::Cow, fmt::Display};

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
pub struct Writer {
    text: String,
    open: Vec<Cow<'static, str>>,
    in_tag: bool,
    is_inline: bool,
    pub(crate) illegal: Vec<(String, &'static str, char)>,
}

impl Writer {
    /// A document with its XML declaration.
    pub fn new() -> Self {
        Self { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>".to_owned(), ..Self::default() }
    }

    /// The text.
    pub fn finish(mut self) -> String {
        self.text.push('\n');
        self.text
    }

    /// Begins a line, unless the open element stays on its own.
    fn begin_line(&mut self) {
        if !self.is_inline {
            self.text.push('\n');
            self.open.iter().for_each(|_| self.text.push_str("  "));
        }
    }

    /// An element; `content` writes its attributes, then the elements in it.
    pub fn element(&mut self, name: impl Into<Cow<'static, str>>, content: impl FnOnce(&mut Self)) {
        let name = name.into();
        if self.in_tag {
            self.text.push('>');
        }
        self.begin_line();
        self.text.push('<');
        self.text.push_str(&name);
        self.open.push(name);
        self.in_tag = true;
        content(self);
        let name = self.open.pop().unwrap_or_default();
        if self.in_tag {
            self.text.push_str("/>");
        } else {
            self.begin_line();
            self.text.push_str("</");
            self.text.push_str(&name);
            self.text.push('>');
        }
        self.in_tag = false;
    }

    /// An element that stands in one line with the elements in it.
    pub fn inline(&mut self, name: impl Into<Cow<'static, str>>, content: impl FnOnce(&mut Self)) {
        self.element(name, |out| {
            out.is_inline = true;
            content(out);
        });
        self.is_inline = false;
    }

    /// An attribute of the element last opened, before its content.
    pub(crate) fn attribute(&mut self, name: &'static str, value: &impl Lexical) {
        let text = value.text();
        if let Some(c) = text.chars().find(|c| !is_xml_char(*c)) {
            let element = self.open.last().cloned().unwrap_or_default();
            self.illegal.push((element.into_owned(), name, c));
        }
        self.shown(name, text);
    }

    /// An attribute with a value as it is shown.
    pub fn shown(&mut self, name: &'static str, value: impl Display) {
        self.text.push(' ');
        self.text.push_str(name);
        self.text.push_str("=\"");
        push_escaped(&mut self.text, &value.to_string());
        self.text.push('"');
    }

    /// An attribute that may be left out.
    pub(crate) fn optional(&mut self, name: &'static str, value: &Option<impl Lexical>) {
        value.iter().for_each(|value| self.attribute(name, value));
    }

    /// A list in an element of its own; nothing of an empty one.
    pub fn list<T>(&mut self, name: &'static str, items: &[T], mut item: impl FnMut(&mut Self, &T)) {
        if !items.is_empty() {
            self.element(name, |out| items.iter().for_each(|value| item(out, value)));
        }
    }
}
