//! The web page's entry point.

fn main() {
    buslens::app::start();
}
