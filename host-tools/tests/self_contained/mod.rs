//! Files that are all that is needed to see them.

/// That a page reaches outside of its file for nothing, and has no number that is none.
pub fn is_self_contained(html: &str) {
    for outside in ["http://", "https://", "<script", "<link", "@import", "url("] {
        assert!(!html.contains(outside), "{outside} reaches outside the file");
    }
    assert!(!html.contains("NaN") && !html.contains("inf\""));
}

/// One picture.
pub fn is_a_picture(svg: &str) {
    assert!(svg.starts_with("<svg xmlns") && svg.matches("<svg").count() == 1);
}
