use buslens::tool::link::Link;

#[derive(Clone, Copy)]
pub struct BuildState;

impl BuildState {
    pub fn new() -> Self {
        Self
    }

    pub fn link(&self) -> Link {
        Link::default()
    }

    pub fn follow(&self, _link: Link) {}
}
