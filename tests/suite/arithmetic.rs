//! Models contain no arithmetic on quantities: they read inputs, call physics and write outputs.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};

use crate::sources::{is_for_tests, rust_files, workspace};

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

    /// Bounds and start values of variables: `start = a * b`.
    fn visit_attribute(&mut self, attribute: &'ast syn::Attribute) {
        let items = attribute.parse_args_with(Punctuated::<syn::Expr, syn::Token![,]>::parse_terminated);
        for item in items.iter().flatten() {
            let mut inside = Self::default();
            inside.visit_expr(item);
            self.0.extend(inside.0);
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
            found.insert(name, operators);
        }
    }
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn operators_on_quantities_are_distinguished_from_indices() {
    let text = "struct S { #[parameter(tunable, min = -1.0, start = rate_rpm * RPM_RAD_S)] rate: Real }\n\
                fn f() { let a = x[i + 1]; let b = force_n * arm_m; let c = -1.0; let d = -b; total += b; }\n\
                #[cfg(test)]\nmod tests { fn g() { a * b; } }";
    assert_eq!(operators(text), ["rate_rpm * RPM_RAD_S", "force_n * arm_m", "- b", "total += b"]);
}
