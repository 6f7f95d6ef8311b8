//! The page that works out checks step by step.

fn main() {
    buslens_page::app::check();
}
