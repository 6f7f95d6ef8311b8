//! The page that shows logs.

fn main() {
    buslens_page::app::logs();
}
