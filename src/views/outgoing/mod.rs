//! What goes out of the page: the summary for a mail, and a log to pass on. Read and the sheet offer both.

mod digest;
mod pass_on;
mod summary;

pub use digest::DigestView;
pub use pass_on::PassOn;
pub use summary::Summary;
