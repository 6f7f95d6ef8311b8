//! A register in every usual interpretation, alone and together with those behind it.

use leptos::prelude::*;

use super::byte_strip::Lights;
use super::telegram::Shown;
use super::wide_table::WideTable;
use buslens::field::{Order, Span};
use buslens::tool::{Kind, View, guess, views};

/// The interpretations of the chosen register, or how to choose one.
#[component]
pub fn Registers(shown: Shown, lights: Lights) -> impl IntoView {
    move || {
        let registers = shown.detail.registers?;
        // Registers are two bytes, counted from the first one.
        let chosen = lights.chosen().map(|chosen| chosen.span.from).filter(|from| registers.contains(*from));
        let from = chosen.unwrap_or(registers.from);
        let from = from - (from - registers.from) % 2;
        let bytes = Span::new(from, registers.to).of(shown.bytes()).to_vec();
        Some(view! { <Interpretations from bytes /> })
    }
}

#[component]
fn Interpretations(from: usize, bytes: Vec<u8>) -> impl IntoView {
    let (views, guess) = (views(&bytes), guess(&bytes));
    let guessed = guess.map(|(kind, order)| {
        view! {
            " With the next two they look like "
            <strong>{format!("a {} number, {}", kind.name(), order.name().0)}</strong>
            ", which is a guess."
        }
    });
    let single: Vec<_> = views
        .iter()
        .filter(|view| view.bits == 16)
        .map(|view| {
            view! {
                <tr>
                    <th scope="row">{view.kind.name()}</th>
                    <td>{view.text.clone()}</td>
                </tr>
            }
        })
        .collect();
    let wide = |bits: usize| {
        let of: Vec<View> = views.iter().filter(|view| view.bits == bits).cloned().collect();
        let guess = guess.filter(|_| bits == 32);
        (!of.is_empty()).then(|| view! { <Wide bits views=of guess /> })
    };
    view! {
        <p class="note">
            {format!("Bytes {from} and {} by themselves, and with what follows them. Choose another register among the bytes.", from + 1)}
            {guessed}
        </p>
        <table class="table interpretations">
            <tbody>{single}</tbody>
        </table>
        {wide(32)}
        {wide(64)}
    }
}

/// Interpretations of so many bits: a row for each order, a column for each kind.
#[component]
fn Wide(bits: usize, views: Vec<View>, guess: Option<(Kind, Order)>) -> impl IntoView {
    let of = |order: Order| views.iter().filter(move |view| view.order == order);
    let kinds: Vec<_> =
        of(Order::Big).map(|view| view! { <th scope="col">{view.kind.name()}</th> }).collect();
    let rows: Vec<_> = Order::ALL
        .into_iter()
        .filter(|order| of(*order).next().is_some())
        .map(|order| {
            let (letters, words) = order.name();
            let cells: Vec<_> = of(order)
                .map(|view| {
                    let is_guess = guess == Some((view.kind, order));
                    view! { <td class:guess=is_guess>{view.text.clone()}</td> }
                })
                .collect();
            view! {
                <tr>
                    <th scope="row">{letters} " " <small class="soft">{words}</small></th>
                    {cells}
                </tr>
            }
        })
        .collect();
    view! {
        <WideTable label=format!("As {bits} bits") class="interpretations">
            <thead>
                <tr>
                    <th scope="col">{format!("{bits} bits")}</th>
                    {kinds}
                </tr>
            </thead>
            <tbody>{rows}</tbody>
        </WideTable>
    }
}
