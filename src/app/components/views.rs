//! A register in every usual view, alone and together with those behind it.

use maud::{Markup, html};

use crate::app::state::Shown;
use buslens::field::{Order, Span};
use buslens::tool::{Kind, View, guess, views};

/// The views of the chosen register, or how to choose one.
pub fn chosen(shown: &Shown, chosen: Option<Span>) -> Markup {
    let Some(registers) = shown.detail.registers else { return html! {} };
    // Registers are two bytes, counted from the first one.
    let from = chosen.map(|span| span.from).filter(|from| registers.contains(*from));
    let Some(from) = from.map(|from| from - (from - registers.from) % 2) else {
        return html! { p { "Choose a register among the bytes or fields to see it here." } };
    };
    let bytes = Span::new(from, registers.to).of(shown.bytes());
    let (views, guess) = (views(bytes), guess(bytes));
    html! {
        p {
            "Bytes " (from) " and " (from + 1) " by themselves, and with what follows them."
            @if let Some((kind, order)) = guess {
                " With the next two they look like " strong.guess { "a " (kind.name()) " number, " (order.name().0) }
                ", which is a guess."
            }
        }
        table.views {
            tbody {
                @for view in views.iter().filter(|view| view.bits == 16) {
                    tr {
                        th scope="row" { (view.kind.name()) }
                        td { (view.text) }
                    }
                }
            }
        }
        @for bits in [32, 64] {
            (table(bits, views.iter().filter(|view| view.bits == bits).collect(), guess.filter(|_| bits == 32)))
        }
    }
}

/// Views of so many bits: a row for each order, a column for each kind.
fn table(bits: usize, views: Vec<&View>, guess: Option<(Kind, Order)>) -> Markup {
    let of = |order: Order| views.iter().filter(move |view| view.order == order);
    html! {
        @if !views.is_empty() {
            table.views {
                thead {
                    tr {
                        th scope="col" { (bits) " bits" }
                        @for view in of(Order::Big) { th scope="col" { (view.kind.name()) } }
                    }
                }
                tbody {
                    @for order in Order::ALL.into_iter().filter(|order| of(*order).next().is_some()) {
                        @let (letters, words) = order.name();
                        tr {
                            th scope="row" { (letters) " " small { (words) } }
                            @for view in of(order) {
                                td class=[(guess == Some((view.kind, order))).then_some("guess")] { (view.text) }
                            }
                        }
                    }
                }
            }
        }
    }
}
