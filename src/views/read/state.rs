use leptos::prelude::*;

use crate::address::Address;
use crate::views::devices::DeviceSettings;
use buslens::tool::link::Link;
use web_sys::File;

#[derive(Clone, Copy)]
pub struct ReadState {
    text: RwSignal<String>,
}

impl ReadState {
    pub fn new(_address: Address, _devices: DeviceSettings) -> Self {
        Self { text: RwSignal::default() }
    }

    pub fn link(&self) -> Link {
        Link::to(self.text.get_untracked(), Default::default())
    }

    pub fn follow(&self, link: Link) {
        self.text.set(link.text);
    }

    pub fn open(&self, _file: File) {}
}
