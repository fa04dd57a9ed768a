//! The attributes of one element, taken by name and converted to their schema types.

use super::error::ReadError;
use crate::finding::Code;
use crate::lexical::Lexical;

/// The attributes of one element that nobody has read yet.
pub(crate) struct Fields {
    pub(crate) element: String,
    pub(crate) line: u32,
    unread: Vec<(String, String)>,
}

impl Fields {
    /// The attributes of the element of this name in a line.
    pub(crate) fn new(element: &str, line: u32, attributes: Vec<(String, String)>) -> Self {
        Self { element: element.to_owned(), line, unread: attributes }
    }

    /// A value that may be missing.
    pub(crate) fn optional<T: Lexical>(&mut self, name: &str) -> Result<Option<T>, ReadError> {
        let Some(at) = self.unread.iter().position(|(key, _)| key == name) else { return Ok(None) };
        let (_, text) = self.unread.swap_remove(at);
        T::parse(&text).map(Some).ok_or_else(|| self.bad(name, &text, &T::allowed()))
    }

    /// A value that must be there.
    pub(crate) fn required<T: Lexical>(&mut self, name: &str) -> Result<T, ReadError> {
        self.optional(name)?.ok_or_else(|| {
            let message = format!("attribute `{name}` is missing; it is required");
            ReadError::new(Code::MissingAttribute, self.line, &self.element, message)
        })
    }

    /// The names of attributes that nobody has read, without those of XML itself and of the schema instance.
    pub(crate) fn unknown(&self) -> impl Iterator<Item = &str> {
        let names = self.unread.iter().map(|(name, _)| name.as_str());
        names.filter(|name| !matches!(name.split(':').next().unwrap_or_default(), "xmlns" | "xsi" | "xml"))
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
