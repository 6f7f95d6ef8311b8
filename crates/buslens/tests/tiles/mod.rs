//! What holds for every tree of fields.

use buslens::field::{Field, leaves};

/// Panics unless the leaves cover 0 to `length` without gap or overlap.
pub fn assert_tiled(fields: &[Field], length: usize) {
    let mut position = 0;
    for leaf in leaves(fields) {
        assert_eq!(leaf.span.from, position, "{}", leaf.spec.key);
        position = leaf.span.to;
    }
    assert_eq!(position, length);
}
