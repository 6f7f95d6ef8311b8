//! The page that reads telegrams.

fn main() {
    buslens::app::decode();
}
