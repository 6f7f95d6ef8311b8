//! Source with all changes in it at once, each behind a switch: one compiler run for thousands of them.

use std::collections::HashMap;
use std::ops::Range;

use proc_macro2::LineColumn;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr};

use crate::list::{Genre, Mutant, Place};

/// What asks whether a change is the one that is tried.
const ASK: &str = "crate::mutants::is";

/// The sides of an operator, by names that nothing else has.
const LEFT: &str = "__left";
const RIGHT: &str = "__right";

/// A part of the source that is written in another way.
#[derive(Debug)]
struct Edit {
    range: Range<usize>,
    parts: Vec<Part>,
    /// Mutants elsewhere that the compiler blames this place for.
    others: Vec<usize>,
}

#[derive(Debug)]
enum Part {
    Text(String),
    /// As the source has it there, with the edits in it.
    Source(Range<usize>),
    /// What stands in place of the source while mutant `.0` is tried.
    Instead(usize, Vec<Part>),
}

/// A file with switches.
#[derive(Debug, Default)]
pub struct Switched {
    pub text: String,
    /// The mutants that have one, by their numbers.
    pub switched: Vec<usize>,
    /// Which text mutants brought in, each by itself and those of one place together: whose fault it is where
    /// it does not compile.
    brought: Vec<(Range<usize>, Vec<usize>)>,
}

impl Switched {
    /// The mutants to leave out where the compiler stumbles at `at`.
    pub fn to_blame(&self, at: usize) -> &[usize] {
        let around = self.brought.iter().filter(|(range, _)| range.contains(&at));
        around.min_by_key(|(range, _)| range.len()).map_or(&[], |(_, mutants)| mutants)
    }
}

/// `source` with `mutants`, which have numbers, behind switches.
pub fn switch(source: &str, mutants: &[(usize, &Mutant)]) -> syn::Result<Switched> {
    let file = syn::parse_file(source)?;
    let mut by_place: HashMap<(Genre, Place), Vec<(usize, &Mutant)>> = HashMap::new();
    for (number, mutant) in mutants {
        by_place.entry((mutant.genre, mutant.span.start)).or_default().push((*number, mutant));
    }
    let mut finder = Finder { by_place, edits: Vec::new(), constant: false };
    finder.visit_file(&file);
    let mut edits = finder.edits;
    // The outer ones first.
    edits.sort_by_key(|edit| (edit.range.start, std::cmp::Reverse(edit.range.end)));
    let mut writer = Writer { source, edits: &edits, switched: Switched::default() };
    writer.write(0..source.len());
    let mut switched = writer.switched;
    switched.switched.sort_unstable();
    switched.switched.dedup();
    Ok(switched)
}

struct Writer<'a> {
    source: &'a str,
    edits: &'a [Edit],
    switched: Switched,
}

impl Writer<'_> {
    /// Writes a range of the source with the edits in it.
    fn write(&mut self, range: Range<usize>) {
        let mut at = range.start;
        let first = self.edits.partition_point(|edit| edit.range.start < range.start);
        for edit in &self.edits[first..] {
            if edit.range.start >= range.end {
                break;
            }
            if edit.range.start < at || edit.range.end > range.end {
                continue;
            }
            self.switched.text.push_str(&self.source[at..edit.range.start]);
            let from = self.switched.text.len();
            let mut mutants = edit.others.clone();
            self.write_parts(&edit.parts, &mut mutants);
            self.switched.brought.push((from..self.switched.text.len(), mutants));
            at = edit.range.end;
        }
        self.switched.text.push_str(&self.source[at..range.end]);
    }

    fn write_parts(&mut self, parts: &[Part], mutants: &mut Vec<usize>) {
        for part in parts {
            match part {
                Part::Text(text) => self.switched.text.push_str(text),
                Part::Source(range) => self.write(range.clone()),
                Part::Instead(number, parts) => {
                    mutants.push(*number);
                    self.switched.switched.push(*number);
                    let from = self.switched.text.len();
                    self.write_parts(parts, &mut Vec::new());
                    self.switched.brought.push((from..self.switched.text.len(), vec![*number]));
                }
            }
        }
    }
}

/// Finds where the mutants are.
struct Finder<'a> {
    by_place: HashMap<(Genre, Place), Vec<(usize, &'a Mutant)>>,
    edits: Vec<Edit>,
    /// Within a function that the compiler may call: no operator of a reference there.
    constant: bool,
}

fn place(at: LineColumn) -> Place {
    Place { line: at.line, column: at.column + 1 }
}

fn range(node: &impl Spanned) -> Range<usize> {
    node.span().byte_range()
}

fn text(text: impl Into<String>) -> Part {
    Part::Text(text.into())
}

/// `if crate::mutants::is(7) { … } else if … else { … }` of expressions.
fn either(mutants: Vec<(usize, Vec<Part>)>, otherwise: Vec<Part>) -> Vec<Part> {
    let mut parts = Vec::new();
    for (number, instead) in mutants {
        parts.push(text(format!("if {ASK}({number}) {{ ")));
        parts.push(Part::Instead(number, instead));
        parts.push(text(" } else "));
    }
    parts.push(text("{ "));
    parts.extend(otherwise);
    parts.push(text(" }"));
    parts
}

impl<'a> Finder<'a> {
    fn take(&mut self, genre: Genre, node: &impl Spanned) -> Vec<(usize, &'a Mutant)> {
        self.by_place.remove(&(genre, place(node.span().start()))).unwrap_or_default()
    }

    fn edit(&mut self, range: Range<usize>, parts: Vec<Part>) {
        self.edits.push(Edit { range, parts, others: Vec::new() });
    }

    /// A function that gives something else.
    fn function(&mut self, constant: bool, block: &syn::Block) {
        let before = std::mem::replace(&mut self.constant, constant);
        if let Some(first) = block.stmts.first() {
            let found = self.take(Genre::FnValue, first);
            if !found.is_empty() {
                let whole = range(block);
                let mut parts = vec![text("{ ")];
                for (number, mutant) in found {
                    parts.push(text(format!("if {ASK}({number}) {{ ")));
                    parts.push(Part::Instead(number, vec![text(format!("return {};", mutant.replacement))]));
                    parts.push(text(" } "));
                }
                parts.push(Part::Source(whole.start + 1..whole.end - 1));
                parts.push(text("}"));
                self.edit(whole, parts);
            }
        }
        visit::visit_block(self, block);
        self.constant = before;
    }

    fn binary(&mut self, binary: &syn::ExprBinary) {
        let found = self.take(Genre::BinaryOperator, &binary.op);
        // What `if let` takes is no expression.
        if found.is_empty() || holds_let(&binary.left) || holds_let(&binary.right) {
            return;
        }
        let (left, right) = (range(&*binary.left), range(&*binary.right));
        let whole = left.start..right.end;
        let own = operator(&binary.op);
        let of = |instead: &str| -> Vec<Part> {
            vec![Part::Source(left.clone()), text(format!(" {instead} ")), Part::Source(right.clone())]
        };
        let named = |instead: &str| vec![text(format!("{LEFT} {instead} {RIGHT}"))];
        let lazy = |instead: &str| vec![text(format!("{LEFT} {instead} ")), Part::Source(right.clone())];
        let assigned = |instead: &str| vec![Part::Source(left.clone()), text(format!(" {instead} {RIGHT}"))];
        let compares = matches!(own, "==" | "!=" | "<" | "<=" | ">" | ">=");
        let short = whole.len() < 40;
        type Way<'w> = &'w dyn Fn(&str) -> Vec<Part>;
        // What is on both sides is written once, since changes are nested in it.
        let (begin, way): (Vec<Part>, Way) = match own {
            _ if self.constant || compares && short => (Vec::new(), &of),
            "&&" | "||" => {
                (vec![text("match "), Part::Source(left.clone()), text(format!(" {{ {LEFT} => "))], &lazy)
            }
            _ if own.len() > 1 && own.ends_with('=') && !compares => (
                vec![text("match "), Part::Source(right.clone()), text(format!(" {{ {RIGHT} => "))],
                &assigned,
            ),
            _ => {
                let by = if compares { "&" } else { "" };
                let begin = vec![
                    text(format!("match ({by}(")),
                    Part::Source(left.clone()),
                    text(format!("), {by}(")),
                    Part::Source(right.clone()),
                    text(format!(")) {{ ({LEFT}, {RIGHT}) => ")),
                ];
                (begin, &named)
            }
        };
        let closed = if begin.is_empty() { "" } else { " }" };
        let instead = found.into_iter().map(|(number, mutant)| (number, way(&mutant.replacement))).collect();
        let mut parts = vec![text("(")];
        parts.extend(begin);
        parts.extend(either(instead, way(own)));
        parts.push(text(format!("{closed})")));
        self.edit(whole, parts);
    }
}

/// Whether an expression is a condition with `let` in it.
fn holds_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => holds_let(&binary.left) || holds_let(&binary.right),
        _ => false,
    }
}

fn operator(operator: &BinOp) -> &'static str {
    match operator {
        BinOp::Add(_) => "+",
        BinOp::Sub(_) => "-",
        BinOp::Mul(_) => "*",
        BinOp::Div(_) => "/",
        BinOp::Rem(_) => "%",
        BinOp::And(_) => "&&",
        BinOp::Or(_) => "||",
        BinOp::BitXor(_) => "^",
        BinOp::BitAnd(_) => "&",
        BinOp::BitOr(_) => "|",
        BinOp::Shl(_) => "<<",
        BinOp::Shr(_) => ">>",
        BinOp::Eq(_) => "==",
        BinOp::Lt(_) => "<",
        BinOp::Le(_) => "<=",
        BinOp::Ne(_) => "!=",
        BinOp::Ge(_) => ">=",
        BinOp::Gt(_) => ">",
        BinOp::AddAssign(_) => "+=",
        BinOp::SubAssign(_) => "-=",
        BinOp::MulAssign(_) => "*=",
        BinOp::DivAssign(_) => "/=",
        BinOp::RemAssign(_) => "%=",
        BinOp::BitXorAssign(_) => "^=",
        BinOp::BitAndAssign(_) => "&=",
        BinOp::BitOrAssign(_) => "|=",
        BinOp::ShlAssign(_) => "<<=",
        BinOp::ShrAssign(_) => ">>=",
        _ => "",
    }
}

impl<'a, 'ast> Visit<'ast> for Finder<'a> {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(item.sig.constness.is_some(), &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(item.sig.constness.is_some(), &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(false, block);
        }
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        self.binary(binary);
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        let found = self.take(Genre::UnaryOperator, &unary.op);
        if !found.is_empty() {
            let whole = range(unary);
            let operand = range(&*unary.expr);
            let own = self_text(&unary.op);
            let instead = found.into_iter().map(|(number, _)| (number, vec![Part::Source(operand.clone())]));
            let mut parts = vec![text("(")];
            parts.extend(either(instead.collect(), vec![text(own), Part::Source(operand.clone())]));
            parts.push(text(")"));
            self.edit(whole, parts);
        }
        visit::visit_expr_unary(self, unary);
    }

    /// An arm with a guard may leave a value without an arm, which is told at what is matched.
    fn visit_expr_match(&mut self, matched: &'ast syn::ExprMatch) {
        let arms = matched
            .arms
            .iter()
            .filter_map(|arm| self.by_place.get(&(Genre::MatchArm, place(arm.span().start()))));
        let others: Vec<usize> = arms.flatten().map(|(number, _)| *number).collect();
        if !others.is_empty() {
            let value = range(&*matched.expr);
            let parts = vec![text("match "), Part::Source(value.clone())];
            self.edits.push(Edit { range: range(&matched.match_token).start..value.end, parts, others });
        }
        visit::visit_expr_match(self, matched);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        let left_out = self.take(Genre::MatchArm, arm);
        let guards = arm.guard.as_ref().map(|(_, guard)| self.take(Genre::MatchArmGuard, guard));
        let guards = guards.unwrap_or_default();
        let guard = arm.guard.as_ref().map(|(_, guard)| guard).filter(|guard| !holds_let(guard));
        if arm.guard.is_some() == guard.is_some() && !(left_out.is_empty() && guards.is_empty()) {
            let from = range(&arm.pat).end;
            let to = arm.guard.as_ref().map_or(from, |(_, guard)| range(&**guard).end);
            let mut parts = vec![text(" if ")];
            for (number, _) in &left_out {
                parts.push(text("!("));
                parts.push(Part::Instead(*number, vec![text(format!("{ASK}({number})"))]));
                parts.push(text(")"));
            }
            if let Some(guard) = guard {
                parts.push(text(if left_out.is_empty() { "(" } else { " && (" }));
                let instead =
                    guards.into_iter().map(|(number, mutant)| (number, vec![text(&mutant.replacement)]));
                parts.extend(either(instead.collect(), vec![Part::Source(range(&**guard))]));
                parts.push(text(")"));
            }
            self.edit(from..to, parts);
        }
        visit::visit_arm(self, arm);
    }

    fn visit_expr_struct(&mut self, made: &'ast syn::ExprStruct) {
        for field in &made.fields {
            let found = self.take(Genre::StructField, field);
            let Some(rest) = made.rest.as_ref().filter(|_| !found.is_empty()) else { continue };
            let (whole, value) = (range(field), range(&field.expr));
            let member = match &field.member {
                syn::Member::Named(name) => name.to_string(),
                syn::Member::Unnamed(index) => index.index.to_string(),
            };
            let given = |_| {
                vec![
                    text("match "),
                    Part::Source(range(&**rest)),
                    text(format!(" {{ {LEFT} => {LEFT}.{member} }}")),
                ]
            };
            let instead = found.into_iter().map(|(number, mutant)| (number, given(mutant))).collect();
            // `Self { body, .. }` names no value.
            let own = if field.colon_token.is_some() { Part::Source(value) } else { text(&member) };
            let mut parts = vec![text(format!("{member}: "))];
            parts.extend(either(instead, vec![own]));
            self.edit(whole, parts);
        }
        visit::visit_expr_struct(self, made);
    }
}

fn self_text(operator: &syn::UnOp) -> &'static str {
    match operator {
        syn::UnOp::Not(_) => "!",
        syn::UnOp::Neg(_) => "-",
        _ => "*",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::list::Span;

    /// `source` with a mutant wherever `changes` find their text, written without superfluous blanks.
    fn switched(source: &str, changes: &[(Genre, &str, &str)]) -> String {
        let mutants: Vec<Mutant> = changes
            .iter()
            .map(|(genre, at, replacement)| {
                let before = &source[..source.find(at).expect(at)];
                let line = before.matches('\n').count() + 1;
                let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
                let span = Span { start: Place { line, column } };
                let (name, file) = (String::new(), String::new());
                Mutant { name, file, genre: *genre, replacement: (*replacement).to_owned(), span }
            })
            .collect();
        let numbered: Vec<(usize, &Mutant)> = mutants.iter().enumerate().collect();
        let switched = switch(source, &numbered).unwrap();
        assert_eq!(switched.switched.len(), changes.len(), "{}", switched.text);
        syn::parse_file(&switched.text).unwrap();
        switched.text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn nothing_is_changed_without_mutants() {
        let source = "fn f() -> u8 {\n    1 + 2 // three\n}\n";
        assert_eq!(switch(source, &[]).unwrap().text, source);
    }

    #[test]
    fn a_function_gives_something_else() {
        assert_eq!(
            switched("fn f() -> u8 { g() }", &[(Genre::FnValue, "g()", "0"), (Genre::FnValue, "g()", "1")]),
            "fn f() -> u8 { if crate::mutants::is(0) { return 0; } if crate::mutants::is(1) { return 1; } g() }"
        );
    }

    #[test]
    fn changes_are_nested() {
        assert_eq!(
            switched(
                "fn f() -> bool { a && !b == long_enough_not_to_be_written_more_than_once }",
                &[
                    (Genre::BinaryOperator, "&&", "||"),
                    (Genre::UnaryOperator, "!", ""),
                    (Genre::BinaryOperator, "==", "!=")
                ]
            ),
            "fn f() -> bool { (match a { __left => if crate::mutants::is(0) { __left || \
             (match (&((if crate::mutants::is(1) { b } else { !b })), &(long_enough_not_to_be_written_more_than_once)) \
             { (__left, __right) => if crate::mutants::is(2) { __left != __right } else { __left == __right } }) } else { __left && \
             (match (&((if crate::mutants::is(1) { b } else { !b })), &(long_enough_not_to_be_written_more_than_once)) \
             { (__left, __right) => if crate::mutants::is(2) { __left != __right } else { __left == __right } }) } }) }"
        );
    }

    #[test]
    fn an_arm_is_left_out_and_its_guard_is_another() {
        assert_eq!(
            switched(
                "fn f() { match x { Some(1) => a, n if c => b, _ => d } }",
                &[(Genre::MatchArm, "Some(1)", ""), (Genre::MatchArmGuard, "c => b", "true")]
            ),
            "fn f() { match x { Some(1) if !(crate::mutants::is(0)) => a, \
             n if (if crate::mutants::is(1) { true } else { c }) => b, _ => d } }"
        );
    }

    #[test]
    fn a_field_is_left_to_the_rest() {
        assert_eq!(
            switched("fn f() -> X { X { a, b: 1, ..X::NEW } }", &[(Genre::StructField, "a, b", "")]),
            "fn f() -> X { X { a: if crate::mutants::is(0) { match X::NEW { __left => __left.a } } else { a }, b: 1, ..X::NEW } }"
        );
    }

    /// In what the compiler calls, too, no references are compared.
    #[test]
    fn constant_functions_stay_constant() {
        assert_eq!(
            switched(
                "const fn f(a: u8) -> bool { a == 0x0000_0000_0000_0000_0000_0000_0000_0000_0000_0001 }",
                &[(Genre::BinaryOperator, "==", "!=")]
            ),
            "const fn f(a: u8) -> bool { (if crate::mutants::is(0) \
             { a != 0x0000_0000_0000_0000_0000_0000_0000_0000_0000_0001 } else \
             { a == 0x0000_0000_0000_0000_0000_0000_0000_0000_0000_0001 }) }"
        );
    }

    #[test]
    fn who_does_not_compile_is_found() {
        let source = "fn f() -> u8 { g() }";
        let span = Span { start: Place { line: 1, column: 16 } };
        let (name, file) = (String::new(), String::new());
        let mutant = Mutant { name, file, genre: Genre::FnValue, replacement: "None".to_owned(), span };
        let switched = switch(source, &[(7, &mutant)]).unwrap();
        assert_eq!(switched.to_blame(switched.text.find("None").unwrap()), [7]);
        assert!(switched.to_blame(0).is_empty());
    }
}
