//! The page that reads telegrams.

fn main() {
    buslens_page::app::decode();
}
