//! All tests in one program, for `cargo xtask mutants`, which builds them once.

#[path = "blocks.rs"]
mod blocks;
#[path = "breaks.rs"]
mod breaks;
#[path = "build.rs"]
mod build;
#[path = "captures.rs"]
mod captures;
#[path = "devices.rs"]
mod devices;
#[path = "devices_in_logs.rs"]
mod devices_in_logs;
#[path = "going_out.rs"]
mod going_out;
#[path = "hypotheses/main.rs"]
mod hypotheses;
#[path = "keb.rs"]
mod keb;
#[path = "kinds.rs"]
mod kinds;
#[path = "laws.rs"]
mod laws;
#[path = "logs/main.rs"]
mod logs;
#[path = "manuals/main.rs"]
mod manuals;
#[path = "memograph.rs"]
mod memograph;
#[path = "oracle.rs"]
mod oracle;
#[path = "posts.rs"]
mod posts;
#[path = "profibus.rs"]
mod profibus;
#[path = "reference.rs"]
mod reference;
#[path = "registry.rs"]
mod registry;
#[path = "spans.rs"]
mod spans;
#[path = "tables.rs"]
mod tables;
#[path = "vectors.rs"]
mod vectors;
