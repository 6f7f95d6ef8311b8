use buslens::tool::link::Link;

#[derive(Clone, Copy)]
pub struct CheckState;

impl CheckState {
    pub fn new() -> Self {
        Self
    }

    pub fn link(&self) -> Link {
        Link::default()
    }

    pub fn follow(&self, _link: Link) {}
}
