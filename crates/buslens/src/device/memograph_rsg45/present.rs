//! What the telegrams so far say of how a Memograph is at present, and which steps fit to that.
//!
//! Changing limits has an order: open editing, change, give a reason, accept. Batches take their names
//! only while they do not run. Source: Memograph M RSG45 Modbus supplement, 2.6.11 and 2.6.13.

use crate::device::{Access, Lesson, Limits, Profile, Registers, Rule, Said, Settings, Taught};
use crate::field::{Message, Problem};
use crate::message;

pub static LESSONS: &[Lesson] = &[
    Lesson { from: BATCHES, count: 3, read: true, learn: batch },
    Lesson { from: LIMITS, count: 1, read: false, learn: limit },
];

pub static RULES: &[Rule] = &[limits, batches, misprinted];

const BATCHES: u16 = 3088;
const LIMITS: u16 = 3216;

/// Functions of limits.
const OPEN: u8 = 1;
const ACCEPT: u8 = 2;
const CHANGE: u8 = 3;
const READ_BACK: u8 = 4;
const REASON: u8 = 5;

fn limit(taught: &Taught, settings: &mut Settings) {
    let [function, number] = (taught.value as u16).to_be_bytes();
    let present = &mut settings.present;
    present.limits_read_back = function == READ_BACK && number != 255;
    present.limits = match function {
        OPEN => Limits::Open,
        CHANGE => Limits::Changed,
        ACCEPT => Limits::Accepted,
        _ => present.limits,
    };
}

fn batch(taught: &Taught, settings: &mut Settings) {
    let [first, second] = (taught.value as u16).to_be_bytes();
    let batches = &mut settings.present.batches;
    if !taught.written {
        // Behind the status a byte for each of the four.
        let Some(at) = taught.n.checked_sub(1).map(|at| 2 * at) else { return };
        batches.iter_mut().skip(at).zip([first, second]).for_each(|(runs, state)| *runs = Some(state == 1));
    } else if let (0, Some(runs)) = (taught.n, batches.get_mut(usize::from(second).wrapping_sub(1))) {
        match first {
            1 => *runs = Some(true),
            2 => *runs = Some(false),
            _ => {}
        }
    }
}

/// The first register of what is written at `from`, as its two bytes.
fn command(registers: &Registers<'_>, from: u16) -> Option<[u8; 2]> {
    let written = registers.start == from && registers.access == Access::Write;
    registers.values.filter(|_| written).and_then(|values| values.first_chunk()).copied()
}

fn limits(_: &'static Profile, registers: &Registers<'_>, settings: &Settings, said: &mut Said) {
    let Some([function, _]) = command(registers, LIMITS) else { return };
    if registers.single && ![OPEN, ACCEPT, READ_BACK].contains(&function) {
        let message = message!("this function of limits can only be written with function 16");
        said.problems.push(Problem::error("function-16", registers.span, message));
    }
    let order = match (function, settings.present.limits) {
        (CHANGE | REASON | ACCEPT, Limits::Accepted) => {
            message!("editing is over since the changes were accepted: open it again first (function 1)")
        }
        (ACCEPT, Limits::Open) => message!("nothing was changed since editing was opened"),
        (CHANGE | REASON | ACCEPT, Limits::Unseen) => {
            note(said, message!("open editing (function 1) has to come before"));
            return;
        }
        _ => return,
    };
    said.problems.push(Problem::warning("order", registers.span, order));
}

fn batches(_: &'static Profile, registers: &Registers<'_>, settings: &Settings, said: &mut Said) {
    let Some([function, number]) = command(registers, BATCHES) else { return };
    let runs = settings.present.batches.get(usize::from(number).wrapping_sub(1)).copied().flatten();
    let order = match (function, runs) {
        (1, Some(true)) => message!("batch {n} runs already", n = number),
        (2, Some(false)) => message!("batch {n} does not run", n = number),
        (3..=6, Some(true)) => {
            message!("batch {n} runs: this is possible only while it does not", n = number)
        }
        _ => return,
    };
    said.problems.push(Problem::warning("order", registers.span, order));
}

/// Adds to what the blocks note.
fn note(said: &mut Said, message: Message) {
    if let Some(block) = said.blocks.first_mut() {
        block.note = Some(message);
    }
}

/// Section 2.6.4 lists the states of maths channels up to 6939, but there are 12 of them.
fn misprinted(_: &'static Profile, registers: &Registers<'_>, _: &Settings, said: &mut Said) {
    for block in said.blocks.iter_mut().filter(|block| block.from <= 6939 && block.to >= 6912) {
        block.field.problems.retain(|problem| problem.code != "not-in-manual");
        let message = message!(
            "the manual lists states of maths channels up to 6939, but has 12 of them: those from 6912 on are most likely a misprint"
        );
        block.field.problems.push(Problem::warning("misprint", registers.span, message));
    }
}
