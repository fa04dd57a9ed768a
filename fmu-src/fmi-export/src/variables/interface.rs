//! Everything that a model declares, free of any version of FMI, and its digest.

use core::fmt::{Display, Write};
use std::collections::BTreeMap;

use super::Values;
use super::variable::{Element, EnumerationType, Item, Kind, Variable};
use crate::dependencies::{Dependencies, Knowns};

/// The declarations of a model.
#[derive(Clone, Debug, Default)]
pub struct Interface {
    /// The variables in the order of declaration.
    pub variables: Vec<Variable>,
    /// The enumerations of these variables, in the order of first use.
    pub enumerations: Vec<EnumerationType>,
    /// Start values (0, false, "" or the first item where none is declared).
    pub start: Values,
}

impl Interface {
    /// Appends a text that changes exactly when a declaration, a start value or a dependency changes. Every entry carries its length,
    /// so no two interfaces share a text.
    pub(crate) fn canonical(&self, dependencies: &Dependencies, text: &mut String) {
        text.push_str("interface 1\n");
        let mut out = Canonical { text, value: String::new() };
        for EnumerationType { name, description, items } in &self.enumerations {
            out.entry("enumeration", name);
            out.entry("description", description);
            for Item { name, value, description } in *items {
                out.entry("item", name);
                out.entry("value", value);
                out.entry("description", description);
            }
        }
        for variable in &self.variables {
            let Variable { name, description, role, dimensions, first, kind } = variable;
            out.entry("variable", name);
            out.entry("description", description);
            out.entry("causality", role.causality);
            out.entry("variability", role.variability);
            out.option("initial", role.initial);
            for length in dimensions {
                out.entry("dimension", length);
            }
            out.element("first", *first);
            out.kind(kind);
            for (_, element) in variable.elements() {
                self.start(&mut out, element);
            }
        }
        let mut lines = KnownLines::default();
        out.rows("step", dependencies.at_steps(), &mut lines);
        out.rows("start", dependencies.at_start(), &mut lines);
    }

    fn start(&self, out: &mut Canonical<'_>, element: Element) {
        let at = element.place() as usize;
        match element {
            Element::Real(_) => out.option("start", self.start.reals.get(at).map(|value| value.to_bits())),
            Element::Integer(_) => out.option("start", self.start.integers.get(at)),
            Element::Boolean(_) => out.option("start", self.start.booleans.get(at)),
            Element::Text(_) => out.option("start", self.start.strings.get(at)),
        }
    }
}

struct Canonical<'a> {
    text: &'a mut String,
    /// Spare memory for one value.
    value: String,
}

impl Canonical<'_> {
    fn entry(&mut self, what: &str, value: impl Display) {
        self.value.clear();
        // Writing to a String cannot fail.
        let _ = write!(self.value, "{value}");
        let _ = write!(self.text, "{what} {}:", self.value.len());
        self.text.push_str(&self.value);
        self.text.push('\n');
    }

    fn option(&mut self, what: &str, value: Option<impl Display>) {
        if let Some(value) = value {
            self.entry(what, value);
        }
    }

    fn element(&mut self, what: &str, element: Element) {
        let table = match element {
            Element::Real(_) => "real",
            Element::Integer(_) => "integer",
            Element::Boolean(_) => "boolean",
            Element::Text(_) => "text",
        };
        self.entry(what, format_args!("{table} {}", element.place()));
    }

    fn kind(&mut self, kind: &Kind) {
        match kind {
            Kind::Real { unit, display_unit, min, max, nominal } => {
                self.entry("unit", unit);
                self.option("displayUnit", display_unit.as_ref());
                for (what, value) in [("min", min), ("max", max), ("nominal", nominal)] {
                    self.option(what, value.map(f64::to_bits));
                }
            }
            Kind::Integer { min, max } => {
                self.option("min", *min);
                self.option("max", *max);
            }
            Kind::Enumeration(name) => self.entry("type", name),
            Kind::Boolean | Kind::Text => {}
        }
    }

    fn rows(&mut self, when: &str, rows: &BTreeMap<Element, Knowns>, lines: &mut KnownLines) {
        // Elements of one array often depend on the same.
        let mut previous = None;
        for (unknown, knowns) in rows {
            self.element(when, *unknown);
            let begin = self.text.len();
            match previous.take() {
                Some((same, span)) if same == knowns => self.text.extend_from_within(span),
                _ => knowns.elements().for_each(|known| self.text.push_str(lines.of(known))),
            }
            previous = Some((knowns, begin..self.text.len()));
        }
    }
}

/// What a row says of each of its knowns, by table and place: the same elements come again in most rows.
#[derive(Default)]
struct KnownLines([Vec<String>; Element::TABLES]);

impl KnownLines {
    fn of(&mut self, known: Element) -> &str {
        let lines = &mut self.0[known.table()];
        let at = known.place() as usize;
        if lines.len() <= at {
            lines.resize(at + 1, String::new());
        }
        let line = &mut lines[at];
        if line.is_empty() {
            Canonical { text: line, value: String::new() }.element("known", known);
        }
        line
    }
}

#[cfg(test)]
mod tests {
    //! The canonical text sees every declared fact, and texts cannot pose as structure.
    use model_description::{Causality, Variability};

    use super::*;
    use crate::knowns;
    use crate::variables::{Declare, Integer, Real, RealSpec, RealVector, Role, ScalarSpec};

    struct Handles {
        input: RealVector<2>,
        output: Real,
        count: Integer,
    }

    fn declared() -> (Interface, Dependencies, Handles) {
        let role = |causality| Role { causality, variability: Variability::Discrete, initial: None };
        let (input, output) = (role(Causality::Input), role(Causality::Output));
        let real = |name, role| RealSpec {
            name,
            description: "A value.",
            role,
            unit: "m",
            display_unit: Some("km"),
            min: None,
            max: Some(5.0),
            nominal: None,
        };
        let mut scope = Declare::new();
        let handles = Handles {
            input: scope.real_vector(&real("input", input), Some([0.5, 1.0])).unwrap(),
            output: scope.real(&real("output", output), None).unwrap(),
            count: {
                let spec = ScalarSpec { name: "count", description: "A number.", role: input };
                scope.integer(&spec, Some(1), None, None).unwrap()
            },
        };
        let mut dependencies = Dependencies::new();
        dependencies.output(handles.output, handles.input, handles.input);
        (scope.finish(), dependencies, handles)
    }

    fn canonical(interface: &Interface, dependencies: &Dependencies) -> String {
        let mut text = String::new();
        interface.canonical(dependencies, &mut text);
        text
    }

    #[test]
    fn every_fact_enters() {
        type Change = (&'static str, fn(&mut Interface, &mut Dependencies, &Handles));
        let changes: &[Change] = &[
            ("order", |it, _, _| it.variables.swap(0, 1)),
            ("name", |it, _, _| it.variables[0].name.push('x')),
            ("description", |it, _, _| it.variables[0].description.push('x')),
            ("causality", |it, _, _| it.variables[0].role.causality = Causality::Local),
            ("variability", |it, _, _| it.variables[0].role.variability = Variability::Continuous),
            ("initial", |it, _, _| {
                it.variables[1].role.initial = Some(model_description::Initial::Approx);
            }),
            ("dimensions", |it, _, _| it.variables[0].dimensions = vec![1, 2]),
            ("place", |it, _, _| it.variables[0].first = Element::Real(1)),
            ("limit", |it, _, _| {
                if let Kind::Real { max, .. } = &mut it.variables[0].kind {
                    *max = max.map(f64::next_up);
                }
            }),
            ("unit", |it, _, _| {
                if let Kind::Real { display_unit, .. } = &mut it.variables[0].kind {
                    *display_unit = None;
                }
            }),
            ("type", |it, _, _| it.variables[2].kind = Kind::Enumeration("E")),
            ("enumeration", |it, _, _| {
                it.enumerations.push(EnumerationType { name: "E", description: "D", items: &[] });
            }),
            ("start of an element", |it, _, h| {
                it.start.set_real(h.input.element(1), 1.0_f64.next_up());
            }),
            ("start of an Integer", |it, _, h| it.start.set_integer(h.count, 2)),
            ("dependency in steps", |_, table, h| table.output(h.output, h.count, knowns![])),
            ("dependency at the start", |_, table, h| table.output(h.output, knowns![], h.count)),
        ];
        let (base, table, _) = declared();
        let base = canonical(&base, &table);
        for (what, change) in changes {
            let (mut interface, mut table, handles) = declared();
            change(&mut interface, &mut table, &handles);
            assert_ne!(canonical(&interface, &table), base, "{what}");
        }
    }

    #[test]
    fn texts_cannot_pose_as_structure() {
        let (mut one, table, _) = declared();
        one.variables[0].description = "x\ncausality 5:input".to_owned();
        let (mut two, _, _) = declared();
        two.variables[0].description = "x".to_owned();
        assert_ne!(canonical(&one, &table), canonical(&two, &table));
    }
}
