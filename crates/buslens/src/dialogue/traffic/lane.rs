//! What waits for the rest of its telegram, and the chunks it came in.

use std::sync::LazyLock;

use super::entry::{Hint, NO_TIME, Written};
use super::pieces::Held;
use crate::field::Facts;
use crate::frame::Protocol;

/// Bytes that wait for the rest of their telegram.
#[derive(Debug, Default)]
pub(super) struct Lane {
    pub(super) buffer: Vec<u8>,
    /// Which chunks the bytes came in.
    pub(super) rows: Vec<Row>,
    /// Telegrams follow each other without anything that parts them.
    pub(super) streaming: bool,
    /// It is a stream by its nature.
    pub(super) stream: bool,
    /// The last telegram ended just before the buffer.
    pub(super) in_step: bool,
    /// In so many bytes at the beginning no telegram begins.
    pub(super) barren: usize,
    /// Of a text: the beginning of a telegram that may go on in the next piece.
    pub(super) held: Option<Held>,
    /// Of a text: what is in the buffer as decimal numbers, and its breaks.
    pub(super) decimal: Vec<u8>,
    pub(super) breaks: Vec<usize>,
    /// Of a connection: what it carries, once its bytes tell.
    pub(super) carries: Carries,
}

/// What a connection carries.
#[derive(Clone, Copy, Debug, Default)]
pub(super) enum Carries {
    #[default]
    Unknown,
    Protocol(&'static Protocol),
    /// No telegrams.
    Foreign,
}

/// A chunk in a lane's buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Its first byte in the buffer; below 0 where that is gone.
    pub(super) from: isize,
    pub(super) time: i64,
    pub(super) hint: Hint,
    pub(super) port: u16,
    pub(super) line: u32,
    pub(super) offset: u64,
    pub(super) written: Option<Written>,
    pub(super) facts: Facts,
}

/// Of bytes that came from nowhere.
static NO_ROW: LazyLock<Row> = LazyLock::new(|| Row {
    from: 0,
    time: NO_TIME,
    hint: Hint::None,
    port: 0,
    line: 0,
    offset: 0,
    written: None,
    facts: Facts::default(),
});

/// Where chunks of a telegram lie further apart, they are none.
pub(super) const PAUSE: i64 = 1_000_000;

impl Row {
    /// Whether a telegram can go on with a chunk of this hint and time.
    pub(super) fn goes_on(&self, hint: Hint, time: i64) -> bool {
        let apart = time != NO_TIME && self.time != NO_TIME && time - self.time > PAUSE;
        !apart && self.hint == hint
    }
}

impl Lane {
    /// How long nothing came before the byte at `at` of the buffer, if that is the first of its chunk;
    /// the end of all counts as the longest pause.
    pub(super) fn pause_before(&self, at: usize, end: usize) -> i64 {
        let next = self.rows.partition_point(|row| row.from < at as isize);
        match self.rows.get(next.saturating_sub(1)..=next) {
            _ if at >= end => i64::MAX,
            Some([before, row]) if row.from == at as isize && row.time != NO_TIME => {
                row.time.saturating_sub(before.time.max(0))
            }
            _ => 0,
        }
    }

    /// The chunk that the byte at `at` of the buffer came in.
    #[inline]
    pub(super) fn row(&self, at: usize) -> &Row {
        // Most came in one.
        match &self.rows[..] {
            [row] => row,
            rows => {
                let next = rows.partition_point(|row| row.from <= at as isize);
                rows.get(next.saturating_sub(1)).unwrap_or(&NO_ROW)
            }
        }
    }

    /// The first `count` bytes are gone.
    pub(super) fn forget(&mut self, count: usize) {
        if count == 0 {
            return;
        }
        for row in &mut self.rows {
            row.from -= count as isize;
        }
        let gone = self.rows.partition_point(|row| row.from <= 0).saturating_sub(1);
        self.rows.drain(..gone);
    }
}
