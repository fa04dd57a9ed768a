//! Statics of the library hold no heap, which would stay behind where the library is unloaded.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::visit::{self, Visit};

use crate::sources::{is_for_tests, rust_files, workspace};

/// Every static with its type.
#[derive(Default)]
struct Statics(Vec<(String, String)>);

impl<'ast> Visit<'ast> for Statics {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_item_static(&mut self, item: &'ast syn::ItemStatic) {
        self.0.push((item.ident.to_string(), item.ty.to_token_stream().to_string().replace(' ', "")));
    }

    /// `thread_local!` and macros that declare statics.
    fn visit_macro(&mut self, item: &'ast syn::Macro) {
        let text = item.tokens.to_string();
        let declared = text.match_indices("static ").filter(|(at, _)| !text[..*at].ends_with('\''));
        for (at, _) in declared {
            let name = text[at + 7..].split([' ', ':']).next().unwrap_or_default();
            self.0.push((name.to_owned(), item.path.to_token_stream().to_string().replace(' ', "")));
        }
    }
}

/// Contents of statics that are set while the library runs, in files that assert that dropping them frees nothing.
const SET_LATER: [(&str, &str); 3] = [
    ("IMPULSE_RULE", "LazyLock<Rule<8>>"),
    ("MODEL", "OnceLock<Model>"),
    ("PAIRS", "[OnceLock<Pairs>;DEGREE+1]"),
];
/// Statics that are constant, or cells of plain data.
const CONSTANT: [(&str, &str); 4] =
    [("LIBRARY", "macro_rules"), ("MARKS", "[u8;2]"), ("ONCE", "Once"), ("PLACE", "thread_local")];

#[test]
fn no_static_of_the_library_holds_heap() {
    let mut found = BTreeMap::new();
    for part in ["physics", "models", "fmi-export", "fmi-export-derive", "component"] {
        for path in rust_files(&workspace().join("fmu-src").join(part).join("src")) {
            let is_tests = path.file_stem().is_some_and(|stem| stem.to_string_lossy().ends_with("tests"));
            if is_tests {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            let mut statics = Statics::default();
            statics.visit_file(&syn::parse_file(&text).unwrap());
            for (name, kind) in statics.0 {
                if let Some((_, held)) = SET_LATER.iter().find(|(known, _)| *known == name) {
                    let held = held.rsplit_once("Lock<").unwrap().1.split([';', ']']).next().unwrap();
                    let asserted = format!("needs_drop::<{}>()", &held[..held.len() - 1]);
                    assert!(text.contains(&asserted), "{}: no {asserted}", path.display());
                }
                found.insert(name, kind);
            }
        }
    }
    let expected =
        SET_LATER.into_iter().chain(CONSTANT).map(|(name, kind)| (name.to_owned(), kind.to_owned()));
    assert_eq!(found, expected.collect());
}
