//! The attributes of one element, taken by name and converted to their schema types.

use super::ReadError;
use super::xml::{Start, Xml};
use crate::finding::Code;

/// What is left of an element's attributes.
pub(super) struct Fields {
    element: String,
    line: u32,
    left: Vec<(String, String)>,
}

impl Fields {
    /// Takes the attributes of `start`.
    pub fn of(start: &mut Start) -> Self {
        let left = core::mem::take(&mut start.attributes);
        Self { element: start.name.clone(), line: start.line, left }
    }

    /// An optional text.
    pub fn text(&mut self, name: &str) -> Option<String> {
        let at = self.left.iter().position(|(key, _)| key == name)?;
        Some(self.left.swap_remove(at).1)
    }

    /// A text that must be there.
    pub fn required(&mut self, name: &str) -> Result<String, ReadError> {
        self.text(name).ok_or_else(|| self.missing(name))
    }

    /// A value of the type that `parse` reads; `allowed` describes it.
    pub fn value<T>(
        &mut self,
        name: &str,
        allowed: &str,
        parse: impl FnOnce(&str) -> Option<T>,
    ) -> Result<Option<T>, ReadError> {
        let Some(text) = self.text(name) else { return Ok(None) };
        match parse(&text) {
            Some(value) => Ok(Some(value)),
            None => Err(self.bad(name, &text, allowed)),
        }
    }

    /// `xs:double`.
    pub fn double(&mut self, name: &str) -> Result<Option<f64>, ReadError> {
        self.value(name, "a number, INF, -INF or NaN", parse_double)
    }

    /// `xs:int`.
    pub fn int(&mut self, name: &str) -> Result<Option<i32>, ReadError> {
        self.value(name, "an integer from -2147483648 to 2147483647", |text| trim(text).parse().ok())
    }

    /// `xs:unsignedInt`.
    pub fn unsigned(&mut self, name: &str) -> Result<Option<u32>, ReadError> {
        self.value(name, "an integer from 0 to 4294967295", |text| trim(text).parse().ok())
    }

    /// `xs:unsignedInt` that must be there.
    pub fn required_unsigned(&mut self, name: &str) -> Result<u32, ReadError> {
        self.unsigned(name)?.ok_or_else(|| self.missing(name))
    }

    /// `xs:boolean`.
    pub fn boolean(&mut self, name: &str) -> Result<Option<bool>, ReadError> {
        self.value(name, "true, false, 1 or 0", |text| match trim(text) {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            _ => None,
        })
    }

    /// `xs:boolean` with default false.
    pub fn flag(&mut self, name: &str) -> Result<bool, ReadError> {
        Ok(self.boolean(name)?.unwrap_or(false))
    }

    /// Warns of every attribute that nobody took; those of XML itself and of the schema instance are fine.
    pub fn finish(self, xml: &mut Xml<'_>) {
        for (name, _) in self.left {
            let prefix = name.split(':').next().unwrap_or_default();
            if !matches!(prefix, "xmlns" | "xsi" | "xml") {
                let message = format!("attribute `{name}` is not one of FMI 2.0; it is ignored");
                xml.warn(Code::UnknownAttribute, self.line, &self.element, message);
            }
        }
    }

    /// The error for an attribute that is not there.
    pub fn missing(&self, name: &str) -> ReadError {
        let message = format!("attribute `{name}` is missing; it is required");
        ReadError::new(Code::MissingAttribute, self.line, &self.element, message)
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

/// White space as XML schema collapses it.
pub(super) fn trim(text: &str) -> &str {
    text.trim_matches([' ', '\t', '\n', '\r'])
}

fn parse_double(text: &str) -> Option<f64> {
    match trim(text) {
        "INF" => Some(f64::INFINITY),
        "-INF" => Some(f64::NEG_INFINITY),
        "NaN" => Some(f64::NAN),
        // Rust also reads words such as `infinity`, which the schema does not allow.
        number if number.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b)) => number.parse().ok(),
        _ => None,
    }
}

/// The words of a list, for the message.
pub(super) fn words<T: Copy>(all: &[T], word: impl Fn(T) -> &'static str) -> String {
    format!("one of {}", all.iter().map(|&value| word(value)).collect::<Vec<_>>().join(", "))
}
