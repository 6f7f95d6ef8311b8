//! The text once more, to stand behind the input: invisible but for its marks.

use maud::{Markup, html};

use crate::app::state::Decoded;
use buslens::field::{Severity, Span};

/// Beyond this many bytes, laying out the text anew at each move of the pointer would be felt.
const LONGEST_LIT: usize = 20_000;
/// Marks beyond these are out of sight anyhow.
const MOST: usize = 500;

/// What cannot be read is marked as bad, the bytes `lit` of the shown telegram as lit.
pub fn marks(decoded: &Decoded, lit: Option<Span>) -> Markup {
    let Decoded { text, report, shown, .. } = decoded;
    let piece = |from: usize, to: usize| text.get(from..to).unwrap_or_default();
    let remarks = report.lines().flat_map(|line| &line.remarks);
    let bad = remarks.filter(|remark| remark.severity == Severity::Error).map(|remark| remark.span);
    let lit = match (lit, shown, text.len()) {
        (Some(lit), Some(shown), ..=LONGEST_LIT) => lit.of(&shown.telegram.line.places),
        _ => &[],
    };
    let mut spans: Vec<(Span, &str)> = Vec::new();
    for (span, class) in bad.take(MOST).map(|span| (span, "bad")).chain(lit.iter().map(|span| (*span, "lit")))
    {
        let at = spans.partition_point(|(other, _)| other.from < span.from);
        spans.insert(at, (span, class));
    }
    // What stands before each mark, and the mark. What stands behind the last one needs no layout.
    let ends = std::iter::once(0).chain(spans.iter().map(|(span, _)| span.to));
    let pieces = ends.zip(&spans).filter(|(end, (span, _))| *end <= span.from);
    html! {
        @for (end, (span, class)) in pieces {
            (piece(end, span.from))
            mark class=(class) { (piece(span.from, span.to)) }
        }
    }
}
