//! Imports run one way in every crate of the workspace: no file uses a second one that uses the first, however far around, and the same
//! holds for the children of every folder, be they files or folders.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};

use crate::sources::{is_for_tests, workspace};

/// Folders of the workspace's crates.
fn members() -> Vec<String> {
    let manifest = fs::read_to_string(workspace().join("Cargo.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    let members = manifest["workspace"]["members"].as_array().unwrap();
    members.iter().map(|member| member.as_str().unwrap().to_owned()).collect()
}

/// Names from the root of a crate to a module.
type Module = Vec<String>;

/// A file with its syntax tree.
struct Source {
    file: PathBuf,
    syntax: syn::File,
}

/// Every module of a crate that has a file of its own.
fn modules(root: &Path) -> BTreeMap<Module, Source> {
    let mut found = BTreeMap::new();
    for (name, folder) in [("lib.rs", root), ("main.rs", root)] {
        if folder.join(name).exists() {
            read(folder.join(name), folder, Vec::new(), &mut found);
        }
    }
    found
}

fn read(file: PathBuf, folder: &Path, module: Module, found: &mut BTreeMap<Module, Source>) {
    let syntax = syn::parse_file(&fs::read_to_string(&file).unwrap()).unwrap();
    for item in &syntax.items {
        let syn::Item::Mod(child) = item else { continue };
        if child.content.is_some() || is_for_tests(&child.attrs) {
            continue;
        }
        let name = child.ident.to_string();
        let beside = folder.join(format!("{name}.rs"));
        let inside = folder.join(&name).join("mod.rs");
        let path = if beside.exists() { beside } else { inside };
        let child_module = [module.clone(), vec![name.clone()]].concat();
        read(path, &folder.join(&name), child_module, found);
    }
    found.insert(module, Source { file, syntax });
}

/// The names that a module's `use` declarations bring in, each with where it comes from.
fn imported(source: &Source) -> Vec<(String, Vec<String>)> {
    fn walk(tree: &syn::UseTree, path: &[String], found: &mut Vec<(String, Vec<String>)>) {
        let with = |name: String| [path, &[name]].concat();
        match tree {
            syn::UseTree::Path(step) => walk(&step.tree, &with(step.ident.to_string()), found),
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| walk(tree, path, found)),
            syn::UseTree::Glob(_) => found.push(("*".to_owned(), path.to_vec())),
            syn::UseTree::Name(name) if name.ident == "self" => {
                found.push((path.last().cloned().unwrap_or_default(), path.to_vec()));
            }
            syn::UseTree::Name(name) => found.push((name.ident.to_string(), with(name.ident.to_string()))),
            syn::UseTree::Rename(name) => found.push((name.rename.to_string(), with(name.ident.to_string()))),
        }
    }
    let mut found = Vec::new();
    for item in &source.syntax.items {
        if let syn::Item::Use(item) = item
            && !is_for_tests(&item.attrs)
        {
            walk(&item.tree, &[], &mut found);
        }
    }
    found
}

/// The paths that stand in the code of a file, tests left out.
#[derive(Default)]
struct Paths(Vec<Vec<String>>);

impl<'ast> Visit<'ast> for Paths {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        if path.segments.len() > 1 {
            self.0.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        visit::visit_path(self, path);
    }
}

/// A crate's modules with what each imports.
struct Crate {
    modules: BTreeMap<Module, Source>,
    imports: BTreeMap<Module, Vec<(String, Vec<String>)>>,
}

impl Crate {
    /// The module in which a path's last name is declared, if that is in this crate; `None` for a bare module too.
    fn declared_in(&self, from: &Module, path: &[String], depth: u32) -> Option<Module> {
        let (first, mut rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" => Vec::new(),
            "self" => from.clone(),
            "super" => from[..from.len().checked_sub(1)?].to_vec(),
            name => {
                let child = [from.clone(), vec![name.to_owned()]].concat();
                if self.modules.contains_key(&child) {
                    child
                } else {
                    let (_, origin) = self.imports[from].iter().find(|(known, _)| known == name)?;
                    let whole = [origin, rest].concat();
                    // The import itself was counted where it stands.
                    return (depth < 8 && origin != path)
                        .then(|| self.declared_in(from, &whole, depth + 1))?;
                }
            }
        };
        while let Some((name, more)) = rest.split_first() {
            if name == "super" {
                at.pop()?;
            } else {
                let child = [at.clone(), vec![name.clone()]].concat();
                if !self.modules.contains_key(&child) {
                    let exported = self.imports[&at].iter().find(|(known, _)| known == name);
                    return match exported {
                        Some((_, origin)) if depth < 8 => {
                            self.declared_in(&at, &[origin, more].concat(), depth + 1)
                        }
                        _ => Some(at),
                    };
                }
                at = child;
            }
            rest = more;
        }
        None
    }

    /// The modules that each module uses.
    fn uses(&self) -> Uses<Module> {
        let mut uses = BTreeMap::new();
        for (module, source) in &self.modules {
            let mut paths = Paths::default();
            paths.visit_file(&source.syntax);
            let imports = self.imports[module].iter().map(|(_, path)| path);
            let used: BTreeSet<Module> = imports
                .chain(&paths.0)
                .filter_map(|path| self.declared_in(module, path, 0))
                .filter(|used| used != module)
                .collect();
            uses.insert(module.clone(), used);
        }
        uses
    }
}

/// The others that each one uses.
type Uses<T> = BTreeMap<T, BTreeSet<T>>;

/// Modules or folders that use one another around a circle, each circle in order.
fn circles<T: Clone + Ord>(uses: &Uses<T>) -> BTreeSet<Vec<T>> {
    let reached = |from: &T| {
        let (mut reached, mut open) = (BTreeSet::new(), vec![from.clone()]);
        while let Some(one) = open.pop() {
            for next in uses.get(&one).into_iter().flatten() {
                if reached.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        reached
    };
    let all: Uses<T> = uses.keys().map(|one| (one.clone(), reached(one))).collect();
    let circle = |one: &T| -> Vec<T> {
        all[one].iter().filter(|other| all.get(*other).is_some_and(|it| it.contains(one))).cloned().collect()
    };
    all.keys().map(circle).filter(|circle| !circle.is_empty()).collect()
}

fn parsed(root: &Path) -> Crate {
    let modules = modules(root);
    let imports = modules.iter().map(|(module, source)| (module.clone(), imported(source))).collect();
    Crate { modules, imports }
}

/// Files of a crate that use one another around a circle.
fn circles_of_files(root: &Path) -> BTreeSet<Vec<String>> {
    let it = parsed(root);
    let name = |module: &Module| {
        it.modules[module].file.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/")
    };
    let named = |circle: Vec<Module>| {
        let mut files: Vec<String> = circle.iter().map(name).collect();
        files.sort();
        files
    };
    circles(&it.uses()).into_iter().map(named).collect()
}

/// Folders of a crate whose children, files or folders, use one another around a circle, with these children; the crate itself is the folder
/// without a name.
fn circles_of_children(root: &Path) -> BTreeMap<String, BTreeSet<Vec<String>>> {
    let mut folders: BTreeMap<&[String], Uses<String>> = BTreeMap::new();
    let uses = parsed(root).uses();
    for (module, used) in &uses {
        for other in used {
            let shared = module.iter().zip(other).take_while(|(a, b)| a == b).count();
            if let (Some(child), Some(used)) = (module.get(shared), other.get(shared)) {
                let folder = folders.entry(&module[..shared]).or_default();
                folder.entry(child.clone()).or_default().insert(used.clone());
            }
        }
    }
    let found = folders.iter().map(|(folder, uses)| (folder.join("/"), circles(uses)));
    found.filter(|(_, circles)| !circles.is_empty()).collect()
}

#[test]
fn no_file_uses_one_that_uses_it() {
    let circles_in =
        |folder: &String| (folder.clone(), circles_of_files(&workspace().join(folder).join("src")));
    let found: BTreeMap<String, BTreeSet<Vec<String>>> =
        members().iter().map(circles_in).filter(|(_, circles)| !circles.is_empty()).collect();
    assert_eq!(found, BTreeMap::new());
}

#[test]
fn no_child_of_a_folder_uses_one_that_uses_it() {
    let mut found = BTreeMap::new();
    for name in members() {
        for (folder, circles) in circles_of_children(&workspace().join(&name).join("src")) {
            found.insert(format!("{name}/src/{folder}"), circles);
        }
    }
    assert!(found.is_empty(), "folders with children that use one another in a circle: {found:#?}");
}

#[test]
fn a_circle_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("lib.rs", "mod a;\nmod b;\nmod c;\npub use a::A;\n");
    write("a.rs", "use crate::b;\npub struct A;\nfn f() { b::g() }\n");
    write("b.rs", "pub fn g() { let _ = super::A; }\n");
    write("c.rs", "use crate::{A, b::g};\n#[cfg(test)]\nmod tests { use super::*; }\n");
    let expected = BTreeSet::from([vec!["a.rs".to_owned(), "b.rs".to_owned()]]);
    assert_eq!(circles_of_files(folder.path()), expected);
}

#[test]
fn a_circle_of_folders_is_seen_where_files_have_none() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    write("lib.rs", "mod top;\n");
    write("top/mod.rs", "mod a;\nmod b;\n");
    write("top/a/mod.rs", "pub mod first;\npub mod last;\n");
    write("top/a/first.rs", "pub struct First;\n");
    write("top/a/last.rs", "use crate::top::b::Middle;\npub struct Last(Middle);\n");
    write("top/b.rs", "use super::a::first::First;\npub struct Middle(First);\n");
    assert!(circles_of_files(folder.path()).is_empty());
    let circle = BTreeSet::from([vec!["a".to_owned(), "b".to_owned()]]);
    assert_eq!(circles_of_children(folder.path()), BTreeMap::from([("top".to_owned(), circle)]));
}
