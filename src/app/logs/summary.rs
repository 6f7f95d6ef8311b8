//! What the whole log says: sentences, a table, the lists to filter by.

use maud::{Markup, html};

use super::rows::milliseconds;
use crate::app::components::settings::list;
use buslens::field::count;
use buslens::tool::log::{Finding, Log, Wanted};
use buslens::tool::{PROFILES, PROTOCOLS};

/// The log in sentences.
pub fn story(log: &Log, name: &str) -> Markup {
    let story = log.story();
    let (first, rest) = story.split_first().map_or((None, &[][..]), |(first, rest)| (Some(first), rest));
    html! {
        p.title { (name) " · read as " strong { (log.format().name()) } }
        @if let Some(fault) = log.fault() { p.error { (fault) } }
        @if let Some(first) = first { h2 { (first.sentence()) "." } }
        ul.story { @for sentence in rest { li { (sentence.sentence()) "." } } }
    }
}

/// What is behind many errors, each with a button to its telegrams.
pub fn findings(findings: &[Finding]) -> Markup {
    html! {
        @if !findings.is_empty() {
            h3 { "What is wrong, as far as the log tells" }
            ol.found {
                @for (index, finding) in findings.iter().enumerate() {
                    li {
                        (finding.text.sentence()) ". "
                        button.link type="button" data-finding=(index) { "Show " (count(finding.evidence.len(), "telegram")) }
                    }
                }
            }
        }
    }
}

/// A row for each unit and function.
pub fn table(log: &Log) -> Markup {
    let dialogs = &log.statistics().dialogs;
    let ports = dialogs.iter().any(|dialog| log.port_name(dialog.port).is_some());
    let number = |n: usize| html! { td.number.quiet-zero[n == 0] { (n) } };
    html! {
        div.scroll tabindex="0" role="region" aria-label="Units and functions" {
            table.dialogs {
                thead {
                    tr {
                        @if ports { th scope="col" { "Line" } }
                        @for title in ["Unit", "Function", "Requests", "Answered", "Unanswered", "Retries", "Exceptions", "Failed checks", "Median", "Worst"] {
                            th scope="col" { (title) }
                        }
                    }
                }
                tbody {
                    @for dialog in dialogs {
                        tr {
                            @if ports { td { (log.port_name(dialog.port).unwrap_or_default()) } }
                            th scope="row" {
                                @match dialog.unit {
                                    Some(unit) => button.link type="button" data-dialog={ (unit) "," (dialog.function) } { (unit) },
                                    None => "–",
                                }
                            }
                            td.number { @if dialog.function > 0 { (dialog.function) } @else { "–" } }
                            (number(dialog.requests))
                            (number(dialog.answered))
                            (number(dialog.unanswered))
                            (number(dialog.retries))
                            (number(dialog.exceptions))
                            (number(dialog.check_failed))
                            td.number { (dialog.median.map_or("–".to_owned(), milliseconds)) }
                            td.number { (dialog.worst.map_or("–".to_owned(), milliseconds)) }
                        }
                    }
                }
            }
        }
    }
}

/// The lists that say how a file is read. They are drawn by the worker: the page need not know any
/// protocol or device.
pub fn settings() -> Markup {
    let protocols = PROTOCOLS.iter().map(|it| (it.key, it.label));
    let devices = PROFILES.iter().map(|it| (it.key, it.label));
    html! {
        (list("device", "Device", Some("Any"), devices))
        (list("protocol", "Protocol", Some("As the bytes tell"), protocols))
        (list("input", "File", Some("As its beginning tells"), [("text", "Text"), ("binary", "Raw bytes of a line"), ("pcap", "Capture of a network")].into_iter()))
        (list("numbers", "Numbers", Some("As the lines tell"), [("hex", "Hex"), ("decimal", "Decimal")].into_iter()))
    }
}

/// The lists to filter by.
pub fn lists(log: &Log) -> Markup {
    let dialogs = &log.statistics().dialogs;
    let mut units: Vec<u8> = dialogs.iter().filter_map(|dialog| dialog.unit).collect();
    let mut functions: Vec<u8> = dialogs.iter().map(|dialog| dialog.function).filter(|it| *it > 0).collect();
    let mut ports: Vec<(u16, String)> =
        dialogs.iter().filter_map(|dialog| Some((dialog.port, log.port_name(dialog.port)?))).collect();
    for numbers in [&mut units, &mut functions] {
        numbers.sort_unstable();
        numbers.dedup();
    }
    ports.dedup();
    let choice = |id: &str, label: &str, all: &str, options: &[(String, String)]| {
        html! {
            label {
                span { (label) }
                select id=(id) {
                    @if !all.is_empty() { option value="" { (all) } }
                    @for (key, text) in options { option value=(key) { (text) } }
                }
            }
        }
    };
    let plain = |numbers: &[u8]| -> Vec<(String, String)> {
        numbers.iter().map(|number| (number.to_string(), number.to_string())).collect()
    };
    let wanted: Vec<(String, String)> =
        Wanted::ALL.iter().map(|wanted| (wanted.key().to_owned(), wanted.label().to_owned())).collect();
    let lines: Vec<(String, String)> =
        ports.into_iter().map(|(port, name)| (port.to_string(), name)).collect();
    let both = [("request", "requests"), ("response", "responses")]
        .map(|(key, text)| (key.to_owned(), text.to_owned()));
    html! {
        (choice("wanted", "Show", "", &wanted))
        (choice("unit", "Unit", "all", &plain(&units)))
        (choice("function", "Function", "all", &plain(&functions)))
        (choice("way", "Direction", "both", &both))
        @if lines.len() > 1 { (choice("port", "Line", "all", &lines)) }
    }
}
