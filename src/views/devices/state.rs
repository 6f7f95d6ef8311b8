use buslens::tool::link::Link;

#[derive(Clone, Copy)]
pub struct DeviceSettings;

impl DeviceSettings {
    pub fn new() -> Self {
        Self
    }

    pub fn link(&self) -> Link {
        Link::default()
    }

    pub fn follow(&self, _link: Link) {}
}

impl DeviceSettings {
    pub fn settings(&self) -> buslens::tool::Settings {
        buslens::tool::Settings::default()
    }
}
