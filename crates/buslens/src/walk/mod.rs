//! One description of a telegram, run in several ways.
//!
//! A [`Telegram`] names its fields in order, once. What happens at each field is the walker's:
//!
//! | walker | product |
//! | --- | --- |
//! | [`read()`] | bytes into the value, and the tree of fields with their spans; [`fill`] without the tree |
//! | [`write()`] | the value into bytes |
//! | [`mod@form`] | the value into entries that a person can edit, and back |
//! | [`mod@guide`] | the reference: what stands where, with limits and notes |
//! | [`sample()`] | a random telegram that keeps its limits, for tests |
//!
//! Reading never fails: what is wrong becomes a [`Problem`](crate::field::Problem) of a field. A
//! telegram that ends too early keeps what it has. [`Stop`] only ends the walk, not the reading.

mod checksum;
mod deviation;
pub mod form;
pub mod guide;
mod read;
mod sample;
mod write;

pub use checksum::{Algorithm, CRC_16_MODBUS, FCS, LRC, crc_residue, crc_step};
pub use deviation::{Deviation, Deviations};
pub use read::{Reading, UNEXPECTED, fill, read};
pub use sample::sample;
pub use write::{Overflow, overflow, write};

use crate::field::{Message, Severity, Spec, push_digits};

/// A telegram, or a part of one, described by its fields in order.
pub trait Telegram {
    /// Shows every field to the walker, first to last.
    ///
    /// Which fields there are may only depend on values already walked.
    fn walk(&mut self, w: &mut dyn Walker) -> Walk;
}

/// Ends a walk early: the bytes ended before the telegram did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop;

/// The outcome of a walk's step; `?` hands a [`Stop`] on.
pub type Walk<T = ()> = Result<T, Stop>;

/// A part of a walk, as a closure.
pub type Part<'a> = &'a mut dyn FnMut(&mut dyn Walker) -> Walk;

/// What a telegram shows its fields to. Numbers are big-endian where their [`Spec`] says nothing else.
///
/// Telegrams use the typed methods ([`u8`](trait.Walker.html#method.u8) and so on, [`list`]) where
/// there are some.
///
/// [`list`]: trait.Walker.html#method.list
pub trait Walker {
    /// A number of `width` bytes.
    fn number(&mut self, spec: &'static Spec, width: usize, raw: &mut u64) -> Walk;

    /// A number that chooses what follows, such as a function code. `choices` names each number's
    /// choice.
    fn select(
        &mut self,
        spec: &'static Spec,
        width: usize,
        raw: &mut u64,
        choices: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk;

    /// How many items follow, written as a number of `width` bytes that counts `size` for each
    /// item (a byte count over registers: 2). Ours to write, the wire's to read. Returns the
    /// number of items.
    fn announce(&mut self, spec: &'static Spec, width: usize, items: usize, size: usize) -> Walk<usize>;

    /// A number that follows from other fields; `None` where they do not tell.
    fn derived(&mut self, spec: &'static Spec, width: usize, expected: Option<u64>) -> Walk;

    /// `count` bytes that are no numbers; `None` for all up to the end of the window.
    fn bytes(&mut self, spec: &'static Spec, bytes: &mut Vec<u8>, count: Option<usize>) -> Walk;

    /// `count` items of the same kind, or, for `None`, one and as many more as there are up to the
    /// end of the window; `first` is the number of the first one, if that is known.
    fn items(
        &mut self,
        spec: &'static Spec,
        items: &mut dyn Items,
        count: Option<usize>,
        first: Option<u64>,
    ) -> Walk;

    /// Fields that belong together under one name.
    fn within(&mut self, spec: &'static Spec, part: Part<'_>) -> Walk;

    /// A payload in an envelope that keeps its last `keep` bytes for itself. What the payload does
    /// not take is shown as unexpected; a payload that ends early does not end the envelope.
    fn window(&mut self, keep: usize, part: Part<'_>) -> Walk;

    /// Check bytes over everything from `from` (a [`mark`](Self::mark)) to here.
    fn checksum(&mut self, spec: &'static Spec, algorithm: &'static Algorithm, from: usize) -> Walk;

    /// How many bytes `part` takes, which the telegram comes to later: for a length in front of
    /// what it counts. The reader takes for it what the window has left, less the `around` bytes
    /// that are not counted. `None` from walkers without bytes.
    fn ahead(&mut self, _around: usize, _part: Part<'_>) -> Option<u64> {
        None
    }

    /// The present place, for [`checksum`](Self::checksum). Walkers without bytes have only one.
    fn mark(&self) -> usize {
        0
    }

    /// Says of the field `spec`, walked just before at the same level, what its own limits cannot
    /// say: a rule that involves other fields. Only the reader listens.
    fn remark(&mut self, _spec: &'static Spec, _severity: Severity, _code: &'static str, _message: Message) {}
}

/// A list's items, whatever their type, for [`Walker::items`].
pub trait Items {
    fn len(&self) -> usize;
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    fn resize(&mut self, count: usize);
    fn walk(&mut self, index: usize, w: &mut dyn Walker) -> Walk;
}

impl<'a> dyn Walker + 'a {
    pub fn u8(&mut self, spec: &'static Spec, value: &mut u8) -> Walk {
        self.sized(spec, 1, value)
    }

    pub fn u16(&mut self, spec: &'static Spec, value: &mut u16) -> Walk {
        self.sized(spec, 2, value)
    }

    pub fn u64(&mut self, spec: &'static Spec, value: &mut u64) -> Walk {
        self.sized(spec, 8, value)
    }

    pub fn u32(&mut self, spec: &'static Spec, value: &mut u32) -> Walk {
        self.sized(spec, 4, value)
    }

    /// `count` items (or `None`, see [`items`](trait.Walker.html#tymethod.items)), each walked by `each`.
    pub fn list<T: Default>(
        &mut self,
        spec: &'static Spec,
        items: &mut Vec<T>,
        count: impl Into<Option<usize>>,
        first: Option<u64>,
        each: impl FnMut(&mut dyn Walker, &mut T) -> Walk,
    ) -> Walk {
        self.items(spec, &mut List { items, each }, count.into(), first)
    }

    /// [`select`](trait.Walker.html#tymethod.select) over a number of this type.
    pub fn choose<T: Copy + Into<u64> + TryFrom<u64>>(
        &mut self,
        spec: &'static Spec,
        width: usize,
        value: &mut T,
        choices: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk {
        let mut raw = (*value).into();
        let walk = self.select(spec, width, &mut raw, choices);
        // A walker never sets more than `width` bytes, so this cannot fail.
        *value = T::try_from(raw).unwrap_or(*value);
        walk
    }

    fn sized<T: Copy + Into<u64> + TryFrom<u64>>(
        &mut self,
        spec: &'static Spec,
        width: usize,
        value: &mut T,
    ) -> Walk {
        let mut raw = (*value).into();
        let walk = self.number(spec, width, &mut raw);
        // A walker never sets more than `width` bytes, so this cannot fail.
        *value = T::try_from(raw).unwrap_or(*value);
        walk
    }
}

struct List<'a, T, F> {
    items: &'a mut Vec<T>,
    each: F,
}

impl<T: Default, F: FnMut(&mut dyn Walker, &mut T) -> Walk> Items for List<'_, T, F> {
    fn len(&self) -> usize {
        self.items.len()
    }

    fn resize(&mut self, count: usize) {
        self.items.resize_with(count, T::default);
    }

    fn walk(&mut self, index: usize, w: &mut dyn Walker) -> Walk {
        (self.each)(w, &mut self.items[index])
    }
}

/// Where a walker stands in the tree, as the keys from the root: `pdu.values.3`.
///
/// The reader, the writer and the form name a computed field by it, so that a value that deviates
/// finds its field again.
#[derive(Clone, Debug, Default)]
struct Path(String);

impl Path {
    fn join(&self, key: &str) -> String {
        if self.0.is_empty() { key.to_owned() } else { [&self.0, ".", key].concat() }
    }

    /// Goes one level down; [`leave`](Self::leave) takes what this returns.
    fn enter(&mut self, key: &str) -> usize {
        let length = self.part();
        self.0.push_str(key);
        length
    }

    /// Goes to the list's item `index`; [`leave`](Self::leave) takes what this returns.
    fn enter_item(&mut self, index: usize) -> usize {
        let length = self.part();
        push_digits(&mut self.0, index as u64, 1);
        length
    }

    /// Puts what parts the next key from those before it; how long the path was.
    fn part(&mut self) -> usize {
        let length = self.0.len();
        if length > 0 {
            self.0.push('.');
        }
        length
    }

    fn leave(&mut self, length: usize) {
        self.0.truncate(length);
    }
}

/// The key of a window in a [`Path`]: there is at most one at each level.
const WINDOW: &str = "window";
