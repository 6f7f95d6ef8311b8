use super::{Body, Server};
use crate::field::Message;
use crate::walk::{Telegram, Walk, Walker};

/// A request that is its function code alone, for what a server tells of itself.
pub struct Bare {
    /// The request in one sentence.
    pub meaning: fn(Message) -> Message,
}

impl Bare {
    pub fn of(meaning: fn(Message) -> Message) -> Box<dyn Body> {
        Box::new(Self { meaning })
    }
}

impl Telegram for Bare {
    fn walk(&mut self, _: &mut dyn Walker) -> Walk {
        Ok(())
    }
}

impl Body for Bare {
    fn meaning(&self, who: Server) -> Message {
        (self.meaning)(who.name())
    }

    fn only_reads(&self) -> bool {
        true
    }
}
