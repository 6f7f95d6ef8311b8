//! The page that builds telegrams.

fn main() {
    buslens::app::build();
}
