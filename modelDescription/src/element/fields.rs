//! The attributes of one element, taken by name and converted to their schema types.

use super::ReadError;
use super::xml::{Start, Xml};
use crate::finding::Code;
use crate::lexical::Lexical;

/// What is left of an element's attributes.
pub(crate) struct Fields {
    element: String,
    line: u32,
    left: Vec<(String, String)>,
}

impl Fields {
    /// Takes the attributes of `start`.
    pub(crate) fn of(start: &mut Start) -> Self {
        let left = core::mem::take(&mut start.attributes);
        Self { element: start.name.clone(), line: start.line, left }
    }

    /// A value that may be missing.
    pub(crate) fn optional<T: Lexical>(&mut self, name: &str) -> Result<Option<T>, ReadError> {
        let Some(at) = self.left.iter().position(|(key, _)| key == name) else { return Ok(None) };
        let (_, text) = self.left.swap_remove(at);
        T::parse(&text).map(Some).ok_or_else(|| self.bad(name, &text, &T::allowed()))
    }

    /// A value that must be there.
    pub(crate) fn required<T: Lexical>(&mut self, name: &str) -> Result<T, ReadError> {
        self.optional(name)?.ok_or_else(|| {
            let message = format!("attribute `{name}` is missing; it is required");
            ReadError::new(Code::MissingAttribute, self.line, &self.element, message)
        })
    }

    /// Warns of every attribute that nobody took; those of XML itself and of the schema instance are fine.
    pub(crate) fn finish(self, xml: &mut Xml<'_>) {
        for (name, _) in self.left {
            let prefix = name.split(':').next().unwrap_or_default();
            if !matches!(prefix, "xmlns" | "xsi" | "xml") {
                let message = format!("attribute `{name}` is not one of FMI 2.0; it is ignored");
                xml.warn(Code::UnknownAttribute, self.line, &self.element, message);
            }
        }
    }

    fn bad(&self, name: &str, text: &str, allowed: &str) -> ReadError {
        let mut shown: String = text.chars().take(40).collect();
        if shown.len() < text.len() {
            shown.push_str("...");
        }
        let message = format!("attribute `{name}` is `{shown}`; allowed is {allowed}");
        ReadError::new(Code::BadValue, self.line, &self.element, message)
    }
}
