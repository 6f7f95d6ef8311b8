//! The worker that reads logs.

fn main() {
    buslens_page::app::log_worker();
}
