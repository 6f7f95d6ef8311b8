//! Pictures: what happened over time, and the values of a register.

use maud::{Markup, html};

use super::rows::milliseconds;
use buslens::tool::log::{Point, Timeline, time_text};

/// The width of a picture, in its own units.
const WIDTH: f64 = 720.0;

/// Telegrams and errors as bars, response times below. A bar chooses its stretch.
pub fn timeline(timeline: &Timeline) -> Markup {
    const BARS: f64 = 90.0;
    const TIMES: f64 = 44.0;
    let Timeline { buckets, timed, from, to } = timeline;
    let most = buckets.iter().map(|bucket| bucket.telegrams.max(bucket.errors)).max().unwrap_or(0).max(1);
    let slowest = buckets.iter().filter_map(|bucket| bucket.worst).max();
    let step = WIDTH / buckets.len().max(1) as f64;
    let height = |n: u32| (f64::from(n) / f64::from(most) * BARS * 10.0).ceil() / 10.0;
    let edge =
        |index: usize| from + (i128::from(to - from) * index as i128 / buckets.len().max(1) as i128) as i64;
    let place = |at: i64| if *timed { time_text(at) } else { format!("telegram {}", at + 1) };
    let total = if slowest.is_some() { BARS + TIMES + 14.0 } else { BARS + 2.0 };
    html! {
        svg.timeline viewBox={ "0 0 " (WIDTH) " " (total) } preserveAspectRatio="none" role="group"
            aria-label="Telegrams and errors over time. Arrow keys go from bar to bar, Enter chooses." {
            line.axis x1="0" x2=(WIDTH) y1=(BARS) y2=(BARS) {}
            @for (index, bucket) in buckets.iter().enumerate() {
                @let x = index as f64 * step;
                @let words = format!("{} to {}: {} telegrams, {} errors", place(edge(index)), place(edge(index + 1)), bucket.telegrams, bucket.errors);
                rect.all x=(round(x)) width=(round(step * 0.86)) y=(BARS - height(bucket.telegrams)) height=(height(bucket.telegrams)) {}
                rect.errors x=(round(x)) width=(round(step * 0.86)) y=(BARS - height(bucket.errors)) height=(height(bucket.errors)) {}
                @if let (Some(worst), Some(slowest)) = (bucket.worst, slowest) {
                    @let scale = |micros: u32| TIMES * f64::from(micros) / f64::from(slowest.max(1));
                    rect.worst x=(round(x)) width=(round(step * 0.86)) y=(round(total - scale(worst))) height=(round(scale(worst))) {}
                    @if let Some(latency) = bucket.latency {
                        rect.latency x=(round(x)) width=(round(step * 0.86)) y=(round(total - scale(latency))) height=(round(scale(latency))) {}
                    }
                }
                rect.hit role="button" x=(round(x)) width=(round(step)) y="0" height=(total) data-stop=""
                    tabindex=(if index == 0 { "0" } else { "-1" }) data-from=(edge(index)) data-to=(edge(index + 1)) data-timed[*timed] aria-label=(words) {
                    title { (words) }
                }
            }
        }
        p.ends {
            span { (place(*from)) }
            span.legend {
                span.key.all {} "telegrams " span.key.errors {} "errors"
                @if let Some(slowest) = slowest { " " span.key.latency {} "response time, up to " (milliseconds(slowest)) }
            }
            span { (place(*to)) }
        }
    }
}

/// The values of a register as a line.
pub fn series(points: &[Point], what: &str) -> Markup {
    const HEIGHT: f64 = 130.0;
    let timed = points.iter().all(|point| point.time.is_some());
    let at = |point: &Point| if timed { point.time.unwrap_or_default() as f64 } else { point.index as f64 };
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    };
    let (left, right) = range(&mut points.iter().map(at));
    let (low, high) = range(&mut points.iter().map(|point| point.value));
    let part = |value: f64, low: f64, high: f64| if high > low { (value - low) / (high - low) } else { 0.5 };
    let x = |point: &Point| round(part(at(point), left, right) * (WIDTH - 12.0) + 6.0);
    let y = |point: &Point| round((1.0 - part(point.value, low, high)) * (HEIGHT - 12.0) + 6.0);
    let line: Vec<String> = points.iter().map(|point| format!("{},{}", x(point), y(point))).collect();
    let place = |point: &Point| point.time.map_or_else(|| format!("telegram {}", point.index + 1), time_text);
    html! {
        @match (points.first(), points.last()) {
            (Some(first), Some(last)) => {
                p.title { (what) ": " (buslens::field::count(points.len(), "value")) ", " (low) " to " (high) }
                svg.series viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="group" aria-label={ (what) " over time" } {
                    polyline points=(line.join(" ")) {}
                    @for (index, point) in points.iter().enumerate() {
                        circle role="button" cx=(x(point)) cy=(y(point)) r="4" data-stop="" data-entry=(point.index)
                            tabindex=(if index == 0 { "0" } else { "-1" }) aria-label={ (place(point)) ": " (point.value) } {
                            title { (place(point)) ": " (point.value) }
                        }
                    }
                }
                p.ends { span { (place(first)) } span { (place(last)) } }
            }
            _ => { p { "No telegram of this log reads or writes that register of that unit." } }
        }
    }
}

fn round(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}
