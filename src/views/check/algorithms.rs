//! The same bytes by other algorithms: which of them gives what stands at the end?

use leptos::prelude::*;

use super::state::{CheckState, Work};
use crate::components::icon::{Glyph, Icon};
use buslens::field::{hex, hex_value};
use buslens::tool::checksums::{ByteOrder, CHECKSUMS, Checksum};
use buslens::tool::steps::CHECKS;

/// What one algorithm says of the bytes.
struct Comparison {
    checksum: &'static Checksum,
    value: String,
    /// The bytes at the end, where it gives them.
    gives: Option<(String, ByteOrder)>,
}

fn comparisons(work: &Work) -> Vec<Comparison> {
    let compare = |checksum: &'static Checksum| {
        let before = work.bytes.len().saturating_sub(checksum.algorithm.width);
        let (data, found) = work.bytes.split_at(before);
        let order = if data.is_empty() { None } else { checksum.gives(data, found) };
        let over = if order.is_some() { data } else { work.data() };
        Comparison {
            checksum,
            value: hex_value(checksum.value(over), checksum.algorithm.width).to_string(),
            gives: order.map(|order| (hex(found), order)),
        }
    };
    CHECKSUMS.iter().map(compare).collect()
}

/// What the comparison comes to.
fn conclusion(comparisons: &[Comparison]) -> String {
    let fitting: Vec<&Comparison> = comparisons.iter().filter(|it| it.gives.is_some()).collect();
    match fitting[..] {
        [] => "None of these gives the bytes at the end.".to_owned(),
        [Comparison { checksum, gives: Some((found, order)), .. }] => {
            let swapped = if *order == ByteOrder::Swapped { ", with its two bytes swapped" } else { "" };
            format!("Only {} gives the {found} at the end{swapped}.", checksum.name)
        }
        _ => {
            let names: Vec<&str> = fitting.iter().map(|it| it.checksum.name).collect();
            format!(
                "{} give the bytes at the end. A check of one byte fits by chance once in 256.",
                names.join(", ")
            )
        }
    }
}

#[component]
pub fn Algorithms() -> impl IntoView {
    let state = expect_context::<CheckState>();
    let work = state.work();
    let row = move |comparison: Comparison| {
        let Comparison { checksum, value, gives } = comparison;
        let kind = checksum.algorithm.kind;
        let followed = move || work.with(|work| work.algorithm.kind) == kind;
        // Those that can be followed step by step.
        let name = if CHECKS.iter().any(|check| check.kind == kind) {
            view! {
                <button type="button" class="link" on:click=move |_| state.choose_algorithm(kind)>
                    {checksum.name}
                </button>
            }
            .into_any()
        } else {
            checksum.name.into_any()
        };
        let sign = gives.map(|(_, order)| {
            let swapped = order == ByteOrder::Swapped;
            view! {
                <span class="state good">
                    <Icon glyph=Glyph::Tick />
                    {if swapped { "fits, swapped" } else { "fits" }}
                </span>
            }
        });
        view! {
            <tr class:chosen=move || followed()>
                <th scope="row">
                    {name} <small>{checksum.used_by}</small>
                </th>
                <td>{sign}</td>
                <td class="mono">{value}</td>
            </tr>
        }
    };
    let rows = move || work.with(|work| comparisons(work).into_iter().map(row).collect_view());
    view! {
        <div class="part">
            <h3>"The same bytes by other algorithms"</h3>
            <table class="table" aria-label="The same bytes by other algorithms">
                <tbody>{move || rows()}</tbody>
            </table>
            <p class="note">{move || work.with(|work| conclusion(&comparisons(work)))}</p>
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::super::state::tests::work;
    use super::*;

    #[test]
    fn the_algorithm_of_a_frame_is_found() {
        for (text, said) in [
            ("01 03 00 C8 00 03 84 35", "Only CRC-16/MODBUS gives the 84 35 at the end."),
            (
                "01 03 00 C8 00 03 35 84",
                "Only CRC-16/MODBUS gives the 35 84 at the end, with its two bytes swapped.",
            ),
            ("31 32 33 34 35 36 37 38 39 3D BB", "Only CRC-16/ARC gives the 3D BB at the end."),
            ("01 02 03 04 05 99", "None of these gives the bytes at the end."),
        ] {
            assert_eq!(conclusion(&comparisons(&work(text))), said);
        }
    }
}
