"""What a blend is written as: files for each format, and which options a format takes."""
