//! The page that shows logs.

fn main() {
    buslens::app::logs();
}
