//! What a built page holds: its anchors, and what it refers to.

use std::collections::BTreeSet;

/// Values of one attribute in a page, character references resolved where addresses have them.
pub fn attribute<'a>(page: &'a str, name: &str) -> Vec<String> {
    let mark = format!(" {name}=\"");
    let rest = |part: &'a str| part.split('"').next().unwrap_or_default().replace("&amp;", "&");
    page.split(&mark).skip(1).map(rest).collect()
}

/// Anchors of a page.
pub fn anchors(page: &str) -> BTreeSet<String> {
    attribute(page, "id").into_iter().collect()
}

/// What a page refers to: links and pictures, style and scripts.
pub fn references(page: &str) -> Vec<String> {
    ["href", "src"].iter().flat_map(|name| attribute(page, name)).collect()
}
