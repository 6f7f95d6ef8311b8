use buslens::field::Direction;
use buslens::modbus::DIALECTS;
use buslens::profibus::Layout;
use buslens::tool::{Options, PROFILES, PROTOCOLS, Profile, Protocol, Settings};

/// Some bytes that choices are made by, and what they are about. Where no bytes are left, the first
/// choice is taken.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    choices: &'a [u8],
    content: &'a [u8],
}

impl<'a> Input<'a> {
    /// The first `choices` bytes are to choose by.
    pub fn new(data: &'a [u8], choices: usize) -> Self {
        let (choices, content) = data.split_at(choices.min(data.len()));
        Self { choices, content }
    }

    /// What is behind the choices.
    pub fn content(self) -> &'a [u8] {
        self.content
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.choices.split_first() else { return 0 };
        self.choices = rest;
        *first
    }

    /// Whether all choices are made.
    pub fn is_over(self) -> bool {
        self.choices.is_empty()
    }

    /// Below `end`, which is 1 to 256.
    pub fn below(&mut self, end: usize) -> usize {
        usize::from(self.byte()) % end
    }

    /// Up to so many bytes.
    pub fn bytes(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.choices.split_at(count.min(self.choices.len()));
        self.choices = rest;
        taken
    }

    pub fn direction(&mut self) -> Direction {
        if self.below(2) == 0 { Direction::Request } else { Direction::Response }
    }

    pub fn protocol(&mut self) -> &'static Protocol {
        PROTOCOLS[self.below(PROTOCOLS.len())]
    }

    /// A device, or none.
    pub fn device(&mut self) -> Option<&'static Profile> {
        PROFILES.get(self.below(PROFILES.len() + 1)).copied()
    }

    /// How devices are set up: mostly as delivered.
    pub fn settings(&mut self) -> Settings {
        let mut settings = Settings::default();
        let flags = self.byte();
        if flags < 128 {
            return settings;
        }
        settings.frame.dialect = DIALECTS[self.below(DIALECTS.len())];
        let profibus = &mut settings.frame.profibus;
        profibus.swap_channel = flags & 1 != 0;
        profibus.swap_process = flags & 2 != 0;
        let sizes = self.byte();
        let (outputs, inputs) = (usize::from(sizes >> 4), usize::from(sizes & 15));
        profibus.layout = Layout { channel: flags & 4 == 0, outputs, inputs };
        settings
    }

    /// How a text is to be read: mostly as it tells itself.
    pub fn options(&mut self) -> Options {
        let by_hand = self.byte();
        Options {
            direction: (by_hand & 7 == 1).then(|| self.direction()),
            protocol: (by_hand & 24 == 8).then(|| self.protocol()),
            device: self.device(),
            settings: self.settings(),
        }
    }
}
