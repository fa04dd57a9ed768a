//! Attribute values as text: the lexical forms of XML schema, one for reader and writer.

use std::borrow::Cow;

/// A value that an attribute may hold.
pub(crate) trait Lexical: Sized {
    /// Names the texts that are allowed.
    #[cfg_attr(not(feature = "reader"), allow(dead_code, reason = "only the reader refuses"))]
    fn allowed() -> String {
        "any text".to_owned()
    }
    /// The value of a text.
    #[cfg_attr(not(feature = "reader"), allow(dead_code, reason = "only the reader parses"))]
    fn parse(text: &str) -> Option<Self>;
    /// The text of the value, unescaped.
    fn text(&self) -> Cow<'_, str>;
}

impl Lexical for String {
    fn parse(text: &str) -> Option<Self> {
        Some(text.to_owned())
    }

    fn text(&self) -> Cow<'_, str> {
        self.as_str().into()
    }
}

/// `xs:double`.
impl Lexical for f64 {
    fn allowed() -> String {
        "a number, INF, -INF or NaN".to_owned()
    }

    fn parse(text: &str) -> Option<Self> {
        match trim(text) {
            "INF" => Some(Self::INFINITY),
            "-INF" => Some(Self::NEG_INFINITY),
            "NaN" => Some(Self::NAN),
            // Rust also reads words such as `infinity`, which the schema does not allow.
            number if number.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b)) => {
                number.parse().ok()
            }
            _ => None,
        }
    }

    fn text(&self) -> Cow<'_, str> {
        double(*self).into()
    }
}

/// The lexical form of xs:double that reads back to the same bits: shortest digits, `INF`, `-INF`, `NaN`.
pub(crate) fn double(value: f64) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "INF".to_owned() } else { "-INF".to_owned() };
    }
    let mut text = format!("{value:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    text
}

macro_rules! integers {
    ($($type:ty),+) => { $(
        impl Lexical for $type {
            fn allowed() -> String {
                format!("an integer from {} to {}", Self::MIN, Self::MAX)
            }

            fn parse(text: &str) -> Option<Self> {
                trim(text).parse().ok()
            }

            fn text(&self) -> Cow<'_, str> {
                self.to_string().into()
            }
        }
    )+ };
}

integers!(i32, u32);

/// `xs:boolean`.
impl Lexical for bool {
    fn allowed() -> String {
        "true, false, 1 or 0".to_owned()
    }

    fn parse(text: &str) -> Option<Self> {
        match trim(text) {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            _ => None,
        }
    }

    fn text(&self) -> Cow<'_, str> {
        self.to_string().into()
    }
}

/// A list: items between white space.
impl<T: Lexical> Lexical for Vec<T> {
    fn allowed() -> String {
        format!("a list with spaces between, each {}", T::allowed())
    }

    fn parse(text: &str) -> Option<Self> {
        text.split(WHITE_SPACE).filter(|word| !word.is_empty()).map(T::parse).collect()
    }

    fn text(&self) -> Cow<'_, str> {
        self.iter().map(T::text).collect::<Vec<_>>().join(" ").into()
    }
}

const WHITE_SPACE: [char; 4] = [' ', '\t', '\n', '\r'];

/// White space as XML schema collapses it.
#[cfg_attr(not(feature = "reader"), allow(dead_code, reason = "only the reader parses"))]
fn trim(text: &str) -> &str {
    text.trim_matches(WHITE_SPACE)
}
