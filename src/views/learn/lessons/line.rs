//! The line over time: how long characters take, and the silence between telegrams.

use leptos::prelude::*;

use buslens::field::decimal;

/// Bits of a character: start, eight of data, parity or a second stop bit, stop.
const BITS: u32 = 11;
/// Above this rate the silence is fixed.
const FASTEST: u32 = 19_200;

/// The silence that ends a telegram, in microseconds.
fn silence(rate: u32) -> f64 {
    if rate > FASTEST { 1750.0 } else { 3.5 * character(rate) }
}

fn character(rate: u32) -> f64 {
    f64::from(BITS) * 1e6 / f64::from(rate)
}

fn milliseconds(micros: f64) -> String {
    decimal(micros / 1000.0, 2) + " ms"
}

/// Telegrams as they take their time on the line, with the silence that parts them.
#[component]
pub fn Line(rate: u32, bytes: Vec<Vec<u8>>) -> impl IntoView {
    let (one, pause) = (character(rate), silence(rate));
    let last = bytes.len().saturating_sub(1);
    let parts: Vec<_> = bytes
        .into_iter()
        .enumerate()
        .map(|(index, bytes)| {
            let length = bytes.len() as f64 * one;
            let cells: Vec<_> = bytes.iter().map(|byte| view! { <i>{format!("{byte:02X}")}</i> }).collect();
            let silence = (index < last).then(|| {
                view! {
                    <li class="silence" style:flex-grow=decimal(pause / one, 3)>
                        <span class="cells"></span>
                        <span class="caption">{format!("silence {}", milliseconds(pause))}</span>
                    </li>
                }
            });
            view! {
                <li class="sent" style:flex-grow=bytes.len().to_string()>
                    <span class="cells">{cells}</span>
                    <span class="caption">
                        {format!("{} characters, {}", bytes.len(), milliseconds(length))}
                    </span>
                </li>
                {silence}
            }
        })
        .collect();
    view! {
        <figure class="on-the-line">
            <ol>{parts}</ol>
            <figcaption class="note">
                {format!(
                    "At {rate} baud a character of {BITS} bits takes {}; a telegram ends with {} of silence.",
                    milliseconds(one),
                    milliseconds(pause),
                )}
            </figcaption>
        </figure>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The times of the Modbus standard for serial lines, 2.5.1.1.
    #[test]
    fn silence_is_three_and_a_half_characters() {
        for (rate, micros) in
            [(1200, 32083.0), (9600, 4010.0), (19_200, 2005.0), (38_400, 1750.0), (115_200, 1750.0)]
        {
            assert!((silence(rate) - micros).abs() < 1.0, "{rate}");
        }
    }
}
