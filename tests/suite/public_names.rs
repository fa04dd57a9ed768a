//! Names at the public face: Modelica tools can take every one, and none stands for a paper's number.

use std::collections::BTreeSet;

use model_description::SimpleTypeKind;

use crate::support::{SHIPPED, description};

/// Keywords of the Modelica language (specification 3.6, section 2.3.3).
const KEYWORDS: &[&str] = &[
    "algorithm",
    "and",
    "annotation",
    "block",
    "break",
    "class",
    "connect",
    "connector",
    "constant",
    "constrainedby",
    "der",
    "discrete",
    "each",
    "else",
    "elseif",
    "elsewhen",
    "encapsulated",
    "end",
    "enumeration",
    "equation",
    "expandable",
    "extends",
    "external",
    "false",
    "final",
    "flow",
    "for",
    "function",
    "if",
    "import",
    "impure",
    "in",
    "initial",
    "inner",
    "input",
    "loop",
    "model",
    "not",
    "operator",
    "or",
    "outer",
    "output",
    "package",
    "parameter",
    "partial",
    "protected",
    "public",
    "pure",
    "record",
    "redeclare",
    "replaceable",
    "return",
    "stream",
    "then",
    "true",
    "type",
    "when",
    "while",
    "within",
];

/// Predefined variables, types, operators and functions (sections 3.6.6, 3.7, 4.9, 10.3, 16), but for the function `vector`: it is
/// no reserved word, and an option of paper 001 is called so.
const BUILT_IN: &[&str] = &[
    "time",
    "Real",
    "Integer",
    "Boolean",
    "String",
    "Clock",
    "ExternalObject",
    "StateSelect",
    "AssertionLevel",
    "abs",
    "sign",
    "sqrt",
    "div",
    "mod",
    "rem",
    "ceil",
    "floor",
    "integer",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "log",
    "log10",
    "getInstanceName",
    "delay",
    "spatialDistribution",
    "cardinality",
    "homotopy",
    "semiLinear",
    "inStream",
    "actualStream",
    "terminal",
    "noEvent",
    "smooth",
    "sample",
    "pre",
    "edge",
    "change",
    "reinit",
    "assert",
    "terminate",
    "promote",
    "ndims",
    "size",
    "scalar",
    "matrix",
    "identity",
    "diagonal",
    "zeros",
    "ones",
    "fill",
    "linspace",
    "min",
    "max",
    "sum",
    "product",
    "transpose",
    "outerProduct",
    "symmetric",
    "cross",
    "skew",
    "cat",
    "array",
    "previous",
    "hold",
    "subSample",
    "superSample",
    "shiftSample",
    "backSample",
    "noClock",
    "firstTick",
    "interval",
    "transition",
    "initialState",
    "activeState",
    "ticksInState",
    "timeInState",
    "rooted",
];

fn segments(name: &str) -> impl Iterator<Item = &str> {
    name.split('.').map(|segment| segment.split('[').next().unwrap())
}

#[test]
fn no_segment_and_no_item_is_a_word_of_the_modelica_language() {
    let taken: BTreeSet<&str> = KEYWORDS.iter().chain(BUILT_IN).copied().collect();
    for model in SHIPPED {
        let description = description(model);
        for variable in &description.variables {
            let clash = segments(&variable.name).find(|segment| taken.contains(segment));
            assert_eq!(clash, None, "{model}: {}", variable.name);
        }
        for definition in &description.types {
            let SimpleTypeKind::Enumeration { items, .. } = &definition.kind else { continue };
            for item in items {
                assert!(!taken.contains(item.name.as_str()), "{model}: {}.{}", definition.name, item.name);
            }
        }
    }
}

#[test]
fn no_name_is_both_a_variable_and_a_parent() {
    for model in SHIPPED {
        let description = description(model);
        let mut parents = BTreeSet::new();
        let mut variables = BTreeSet::new();
        for variable in &description.variables {
            let name: Vec<&str> = segments(&variable.name).collect();
            parents.extend((1..name.len()).map(|length| name[..length].join(".")));
            variables.insert(name.join("."));
        }
        let both: Vec<_> = parents.intersection(&variables).collect();
        assert!(both.is_empty(), "{model}: {both:?}");
    }
}

#[test]
fn no_paper_is_counted_in_a_name() {
    for model in SHIPPED {
        let description = description(model);
        let items = description.types.iter().flat_map(|definition| match &definition.kind {
            SimpleTypeKind::Enumeration { items, .. } => items.iter().map(|item| item.name.clone()).collect(),
            _ => Vec::new(),
        });
        for name in description.variables.iter().map(|variable| variable.name.clone()).chain(items) {
            let lower = name.to_lowercase();
            assert!(!["paper", "printed", "eq20"].iter().any(|word| lower.contains(word)), "{model}: {name}");
        }
    }
}
