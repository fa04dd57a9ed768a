//! Models contain no arithmetic on quantities: they read inputs, call physics and write outputs.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::visit::{self, Visit};

use crate::sources::{is_for_tests, rust_files, workspace};

/// Files of the models with operators on quantities, and how many each still has. The list is to become empty.
const LEFT: &[(&str, usize)] = &[
    ("disturbance_torque/mod.rs", 2),
    ("disturbance_torque/outputs.rs", 1),
    ("disturbance_torque/prepared.rs", 3),
    ("momentum_plant/center.rs", 2),
    ("momentum_plant/configure.rs", 5),
    ("momentum_plant/defaults.rs", 3),
    ("momentum_plant/mod.rs", 3),
    ("momentum_plant/outputs.rs", 7),
    ("momentum_plant/state.rs", 1),
    ("spin_plant/mod.rs", 9),
    ("spin_plant/outputs.rs", 4),
    ("spin_plant/read.rs", 4),
    ("spin_plant/variables/mod.rs", 2),
];

/// Expressions with an arithmetic operator, but for those that count or index: with a whole number as an operand.
#[derive(Default)]
struct Operators(Vec<String>);

/// Whether this is a whole number, or counts things.
fn counts(expression: &syn::Expr) -> bool {
    match expression {
        syn::Expr::Lit(it) => matches!(it.lit, syn::Lit::Int(_)),
        syn::Expr::MethodCall(it) => ["len", "count", "index"].iter().any(|name| it.method == name),
        syn::Expr::Path(it) => it.path.is_ident("index") || it.path.is_ident("count"),
        syn::Expr::Cast(it) => it.ty.to_token_stream().to_string() != "f64",
        syn::Expr::Paren(it) => counts(&it.expr),
        syn::Expr::Binary(it) => counts(&it.left) || counts(&it.right),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Operators {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_expr_binary(&mut self, expression: &'ast syn::ExprBinary) {
        use syn::BinOp;
        let is_arithmetic = matches!(
            expression.op,
            BinOp::Add(_)
                | BinOp::Sub(_)
                | BinOp::Mul(_)
                | BinOp::Div(_)
                | BinOp::Rem(_)
                | BinOp::AddAssign(_)
                | BinOp::SubAssign(_)
                | BinOp::MulAssign(_)
                | BinOp::DivAssign(_)
        );
        if is_arithmetic && !counts(&expression.left) && !counts(&expression.right) {
            self.0.push(expression.to_token_stream().to_string());
        }
        visit::visit_expr_binary(self, expression);
    }

    fn visit_expr_unary(&mut self, expression: &'ast syn::ExprUnary) {
        // A negative literal is a value, not an operation.
        let is_literal = matches!(*expression.expr, syn::Expr::Lit(_));
        if matches!(expression.op, syn::UnOp::Neg(_)) && !is_literal {
            self.0.push(expression.to_token_stream().to_string());
        }
        visit::visit_expr_unary(self, expression);
    }
}

fn operators(text: &str) -> Vec<String> {
    let mut operators = Operators::default();
    operators.visit_file(&syn::parse_file(text).unwrap());
    operators.0
}

#[test]
fn models_contain_no_arithmetic_on_quantities() {
    let root = workspace().join("fmu-src").join("models").join("src");
    let mut found = BTreeMap::new();
    for file in rust_files(&root) {
        let name = file.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/");
        let operators = operators(&std::fs::read_to_string(&file).unwrap());
        if !operators.is_empty() {
            eprintln!("{name}:\n  {}", operators.join("\n  "));
            found.insert(name, operators.len());
        }
    }
    let left: BTreeMap<String, usize> =
        LEFT.iter().map(|(name, count)| ((*name).to_owned(), *count)).collect();
    assert_eq!(found, left);
}

#[test]
fn operators_on_quantities_are_distinguished_from_indices() {
    let text = "fn f() { let a = x[i + 1]; let b = force_n * arm_m; let c = -1.0; let d = -b; total += b; }\n\
                #[cfg(test)]\nmod tests { fn g() { a * b; } }";
    assert_eq!(operators(text), ["force_n * arm_m", "- b", "total += b"]);
}
