"""Composes the stages: config and drawing in, a folder of files out."""
