//! The shape of telegrams that carry no data: their service access point says it all.

use super::Body;
use crate::field::Message;
use crate::walk::{Telegram, Walk, Walker};

/// A telegram without data, and its sentence.
pub struct NoData {
    pub meaning: fn(Message) -> Message,
}

impl Telegram for NoData {
    fn walk(&mut self, _: &mut dyn Walker) -> Walk {
        Ok(())
    }
}

impl Body for NoData {
    fn meaning(&self, who: Message) -> Message {
        (self.meaning)(who)
    }
}
