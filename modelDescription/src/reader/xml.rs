//! Elements and their attributes, pulled one after another from bounded, well-formed UTF-8 XML.

use quick_xml::XmlVersion;
use quick_xml::events::{BytesDecl, BytesStart, Event};
use quick_xml::reader::Reader;

use crate::element::{Fields, ReadError};
use crate::finding::{Code, Finding};
use crate::writer::is_xml_char;

/// Larger files are refused; the largest real ones, with a million variables, have about 300 MB.
pub const MAX_BYTES: usize = 512 << 20;
/// Deeper nesting is refused; FMI needs 6, vendor annotations a few more.
const MAX_DEPTH: usize = 256;
/// More attributes on one element are refused; FMI has at most 13.
const MAX_ATTRIBUTES: usize = 64;
/// More warnings are not kept: a file of another schema would give one a line.
const MAX_WARNINGS: usize = 1000;

/// A start tag.
#[derive(Clone, Debug)]
pub struct Start {
    /// Name with its prefix.
    pub name: String,
    /// Line, 1-based.
    pub line: u32,
    /// Attributes as they stand, without entities.
    pub attributes: Vec<(String, String)>,
    empty: bool,
}

impl Start {
    /// The name without its prefix.
    pub fn local(&self) -> &str {
        self.name.rsplit_once(':').map_or(self.name.as_str(), |(_, name)| name)
    }

    /// The value of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// Takes the attributes out of the tag.
    pub(crate) fn fields(&mut self) -> Fields {
        Fields::new(&self.name, self.line, core::mem::take(&mut self.attributes))
    }
}

/// The document as a stream of start tags.
pub struct Xml<'a> {
    reader: Reader<&'a [u8]>,
    text: &'a str,
    counted: usize,
    line: u32,
    depth: usize,
    warnings: Vec<Finding>,
}

impl<'a> Xml<'a> {
    /// The stream of a whole file.
    ///
    /// # Errors
    /// Larger than any real file, not UTF-8, characters that XML does not allow.
    pub fn new(bytes: &'a [u8]) -> Result<Self, ReadError> {
        if bytes.len() > MAX_BYTES {
            let message = format!("the file has {} bytes; allowed are {MAX_BYTES}", bytes.len());
            return Err(ReadError::new(Code::TooLarge, 1, "", message));
        }
        let text = decode(bytes)?;
        if let Some((at, c)) = text.char_indices().find(|&(_, c)| !is_xml_char(c)) {
            let line = 1 + newlines(&text.as_bytes()[..at]);
            let message = format!("the character U+{:04X} is not allowed in XML 1.0", u32::from(c));
            return Err(malformed(line, "", message));
        }
        let mut reader = Reader::from_str(text);
        reader.config_mut().check_comments = true;
        Ok(Self { reader, text, counted: 0, line: 1, depth: 0, warnings: Vec::new() })
    }

    /// The root element, after the XML declaration.
    ///
    /// # Errors
    /// XML that is not well-formed or nested too deep.
    pub fn root(&mut self) -> Result<Start, ReadError> {
        loop {
            let (line, event) = self.next("")?;
            match event {
                Event::Decl(declaration) => self.declaration(line, &declaration)?,
                Event::Start(tag) => return self.start(line, &tag, false),
                Event::Empty(tag) => return self.start(line, &tag, true),
                Event::Comment(_) | Event::PI(_) | Event::DocType(_) => {}
                Event::Text(text) if text.trim_ascii().is_empty() => {}
                Event::Eof => return Err(malformed(line, "", "the file ends before its first element")),
                _ => return Err(malformed(line, "", "text stands before the first element")),
            }
        }
    }

    /// The next child of `parent`, or `None` at its end tag.
    ///
    /// # Errors
    /// XML that is not well-formed or nested too deep.
    pub fn child(&mut self, parent: &Start) -> Result<Option<Start>, ReadError> {
        if parent.empty {
            return Ok(None);
        }
        loop {
            let (line, event) = self.next(&parent.name)?;
            match event {
                Event::Start(tag) => return self.start(line, &tag, false).map(Some),
                Event::Empty(tag) => return self.start(line, &tag, true).map(Some),
                Event::End(_) => {
                    self.depth -= 1;
                    return Ok(None);
                }
                Event::Text(text) if text.trim_ascii().is_empty() => {}
                Event::Text(_) | Event::CData(_) | Event::GeneralRef(_) => {
                    let message = "text inside the element is ignored; allowed are elements".to_owned();
                    self.warn(Code::UnexpectedText, line, &parent.name, message);
                }
                Event::Eof => return Err(ends_inside(line, parent)),
                Event::Comment(_) | Event::PI(_) | Event::DocType(_) | Event::Decl(_) => {}
            }
        }
    }

    /// Reads past everything inside `start`.
    ///
    /// # Errors
    /// XML that is not well-formed or nested too deep.
    pub fn skip(&mut self, start: &Start) -> Result<(), ReadError> {
        if start.empty {
            return Ok(());
        }
        let outside = self.depth - 1;
        while self.depth > outside {
            let (line, event) = self.next(&start.name)?;
            match event {
                Event::Start(tag) => {
                    check_name(tag.name().as_ref(), line, &start.name)?;
                    self.deeper(line, &start.name)?;
                }
                Event::Empty(tag) => check_name(tag.name().as_ref(), line, &start.name)?,
                Event::End(_) => self.depth -= 1,
                Event::Eof => return Err(ends_inside(line, start)),
                _ => {}
            }
        }
        Ok(())
    }

    /// Checks that nothing but comments follows the root element; gives the warnings.
    ///
    /// # Errors
    /// XML that is not well-formed or nested too deep.
    pub fn finish(mut self) -> Result<Vec<Finding>, ReadError> {
        loop {
            let (line, event) = self.next("")?;
            match event {
                Event::Eof => return Ok(self.warnings),
                Event::Comment(_) | Event::PI(_) => {}
                Event::Text(text) if text.trim_ascii().is_empty() => {}
                _ => return Err(malformed(line, "", "something follows the end of the root element")),
            }
        }
    }

    /// Keeps a warning; [`Xml::finish`] gives them.
    pub fn warn(&mut self, code: Code, line: u32, element: &str, message: String) {
        if self.warnings.len() < MAX_WARNINGS {
            self.warnings.push(Finding { code, subject: format!("<{element}>"), line: Some(line), message });
        }
    }

    /// Warns of every attribute that nobody has read.
    pub(crate) fn warn_of_unknown(&mut self, fields: &Fields) {
        for name in fields.unknown() {
            let message = format!("attribute `{name}` is not one of FMI 2.0; it is ignored");
            self.warn(Code::UnknownAttribute, fields.line, &fields.element, message);
        }
    }

    fn next(&mut self, element: &str) -> Result<(u32, Event<'a>), ReadError> {
        let line = self.line_at(self.reader.buffer_position());
        match self.reader.read_event() {
            Ok(event) => Ok((line, event)),
            Err(error) => {
                let line = self.line_at(self.reader.error_position());
                Err(malformed(line, element, error.to_string()))
            }
        }
    }

    /// Line of a byte offset; offsets mostly grow, so the count continues from the last one.
    fn line_at(&mut self, offset: u64) -> u32 {
        let offset = usize::try_from(offset).unwrap_or(usize::MAX).min(self.text.len());
        let bytes = self.text.as_bytes();
        if offset >= self.counted {
            self.line += newlines(&bytes[self.counted..offset]);
        } else {
            self.line -= newlines(&bytes[offset..self.counted]);
        }
        self.counted = offset;
        self.line
    }

    fn deeper(&mut self, line: u32, element: &str) -> Result<(), ReadError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            let message = format!("elements are nested more than {MAX_DEPTH} deep");
            return Err(ReadError::new(Code::TooLarge, line, element, message));
        }
        Ok(())
    }

    fn start(&mut self, line: u32, tag: &BytesStart<'_>, empty: bool) -> Result<Start, ReadError> {
        let name = tag.name().as_ref().to_owned();
        check_name(&name, line, "")?;
        if !empty {
            self.deeper(line, &name)?;
        }
        let mut attributes: Vec<(String, String)> = Vec::new();
        // The library's own check for duplicates takes quadratic time before the limit is seen.
        for attribute in tag.attributes().with_checks(false) {
            let malformed = |message: String| malformed(line, &name, message);
            let attribute = attribute.map_err(|error| malformed(error.to_string()))?;
            let key = attribute.key.as_ref().to_owned();
            check_name(&key, line, &name)?;
            if attribute.value.contains('<') {
                return Err(malformed(format!("attribute `{key}` holds `<`; allowed is `&lt;`")));
            }
            let value = attribute
                .normalized_value(XmlVersion::Explicit1_0)
                .map_err(|error| malformed(format!("attribute `{key}`: {error}")))?;
            if attributes.len() == MAX_ATTRIBUTES {
                let message = format!("more than {MAX_ATTRIBUTES} attributes on one element");
                return Err(ReadError::new(Code::TooLarge, line, &name, message));
            }
            if attributes.iter().any(|(known, _)| *known == key) {
                return Err(malformed(format!("attribute `{key}` stands twice; allowed is once")));
            }
            attributes.push((key, value.into_owned()));
        }
        Ok(Start { name, line, attributes, empty })
    }

    fn declaration(&mut self, line: u32, declaration: &BytesDecl<'_>) -> Result<(), ReadError> {
        let Some(Ok(encoding)) = declaration.encoding() else { return Ok(()) };
        if ["utf-8", "utf8", "us-ascii"].contains(&encoding.to_ascii_lowercase().as_str()) {
            return Ok(());
        }
        if self.text.is_ascii() {
            let message =
                format!("declares encoding `{encoding}`; allowed is UTF-8 (the text is plain ASCII)");
            self.warn(Code::Encoding, line, "?xml", message);
            return Ok(());
        }
        let message = format!("the file declares encoding `{encoding}`; allowed is UTF-8");
        Err(ReadError::new(Code::Encoding, line, "?xml", message))
    }
}

/// Names of elements and attributes: no white space, markup or punctuation but `_ : - .`, no digit first.
fn check_name(name: &str, line: u32, element: &str) -> Result<(), ReadError> {
    let starts = |c: char| c.is_ascii_alphabetic() || c == '_' || c == ':' || !c.is_ascii();
    let goes_on = |c: char| starts(c) || c.is_ascii_digit() || c == '-' || c == '.';
    if name.starts_with(starts) && name.chars().all(goes_on) {
        return Ok(());
    }
    let shown: String = name.chars().take(40).collect();
    Err(malformed(line, element, format!("`{shown}` is no XML name")))
}

fn decode(bytes: &[u8]) -> Result<&str, ReadError> {
    let error = |line, message| Err(ReadError::new(Code::Encoding, line, "", message));
    if bytes.starts_with(&[0xFE, 0xFF]) || bytes.starts_with(&[0xFF, 0xFE]) {
        return error(1, "the file is encoded in UTF-16; allowed is UTF-8".to_owned());
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if bytes.starts_with(&[0, b'<']) || bytes.starts_with(&[b'<', 0]) {
        return error(1, "the file is encoded in UTF-16 or UTF-32; allowed is UTF-8".to_owned());
    }
    match core::str::from_utf8(bytes) {
        Ok(text) => Ok(text),
        Err(problem) => {
            let (good, rest) = bytes.split_at(problem.valid_up_to());
            let byte = rest.first().copied().unwrap_or_default();
            error(1 + newlines(good), format!("byte 0x{byte:02X} is not UTF-8; allowed is UTF-8 only"))
        }
    }
}

fn malformed(line: u32, element: &str, message: impl Into<String>) -> ReadError {
    ReadError::new(Code::Malformed, line, element, message.into())
}

fn ends_inside(line: u32, element: &Start) -> ReadError {
    malformed(line, &element.name, format!("the file ends inside <{}>", element.name))
}

fn newlines(bytes: &[u8]) -> u32 {
    bytes.iter().map(|&b| u32::from(b == b'\n')).sum()
}
