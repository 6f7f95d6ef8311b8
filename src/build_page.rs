//! The page that builds telegrams.

fn main() {
    buslens_page::app::build();
}
