//! The page in a browser, a file for each part of it. One program, so that a browser is free for the next test
//! as soon as one ends.

mod aloud;
mod build;
mod check;
mod devices;
mod going_out;
mod lessons;
mod links;
mod log;
mod offline;
mod practice;
mod promises;
mod read;
mod reference;
mod sheet;
mod speed;
mod typed;
